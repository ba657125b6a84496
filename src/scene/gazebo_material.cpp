#include "scene/gazebo_material.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <sstream>
#include <utility>
#include <vector>

#include "scene/color.h"
#include "scene/ogre_words.h"

namespace sunlit::scene {
namespace {

/// What a colour is the colour of.
enum class Of { kPaint, kGlow, kPicture };

struct NamedLook {
  const char* name;
  std::array<float, 3> display;  ///< as on a screen
  Of of = Of::kPaint;
  float opacity = 1.0f;
};

/// Gazebo's own materials by their diffuse colours (media/materials/scripts/gazebo.material of Gazebo
/// classic), those with a picture by a colour that looks like it.
constexpr NamedLook kLooks[] = {{"Grey", {0.7f, 0.7f, 0.7f}},
                                {"Gray", {0.7f, 0.7f, 0.7f}},
                                {"DarkGrey", {0.175f, 0.175f, 0.175f}},
                                {"DarkGray", {0.175f, 0.175f, 0.175f}},
                                {"LightGrey", {0.8f, 0.8f, 0.8f}},
                                {"White", {1.0f, 1.0f, 1.0f}},
                                {"FlatBlack", {0.1f, 0.1f, 0.1f}},
                                {"Black", {0.0f, 0.0f, 0.0f}},
                                {"Red", {1.0f, 0.0f, 0.0f}},
                                {"RedBright", {0.87f, 0.26f, 0.07f}},
                                {"Green", {0.0f, 1.0f, 0.0f}},
                                {"Blue", {0.0f, 0.0f, 1.0f}},
                                {"SkyBlue", {0.13f, 0.44f, 0.70f}},
                                {"Yellow", {1.0f, 1.0f, 0.0f}},
                                {"ZincYellow", {0.97f, 0.95f, 0.21f}},
                                {"DarkYellow", {0.7f, 0.7f, 0.0f}},
                                {"DarkOrange", {0.7f, 0.36f, 0.03f}},
                                {"Orange", {1.0f, 0.51f, 0.05f}},
                                {"Purple", {1.0f, 0.0f, 1.0f}},
                                {"DarkMagenta", {0.7f, 0.0f, 0.7f}},
                                {"Turquoise", {0.0f, 1.0f, 1.0f}},
                                {"Indigo", {0.33f, 0.0f, 0.5f}},
                                {"Gold", {0.8f, 0.65f, 0.25f}},
                                {"Wood", {0.55f, 0.42f, 0.28f}, Of::kPicture},
                                {"WoodFloor", {0.60f, 0.45f, 0.30f}, Of::kPicture},
                                {"WoodPallet", {0.62f, 0.48f, 0.32f}, Of::kPicture},
                                {"Bricks", {0.58f, 0.33f, 0.26f}, Of::kPicture},
                                {"CeilingTiled", {0.80f, 0.80f, 0.78f}, Of::kPicture},
                                {"PaintedWall", {0.78f, 0.76f, 0.70f}, Of::kPicture},
                                {"CloudySky", {0.60f, 0.70f, 0.80f}, Of::kPicture},
                                {"Grass", {0.30f, 0.42f, 0.18f}, Of::kPicture},
                                {"Road", {0.32f, 0.32f, 0.32f}, Of::kPicture},
                                {"Asphalt", {0.30f, 0.30f, 0.30f}, Of::kPicture},
                                {"Residential", {0.35f, 0.35f, 0.35f}, Of::kPicture},
                                {"Pedestrian", {0.55f, 0.52f, 0.50f}, Of::kPicture},
                                {"Rocky", {0.45f, 0.42f, 0.38f}, Of::kPicture},
                                {"Chrome", {0.75f, 0.75f, 0.75f}, Of::kPicture},
                                {"WhiteGlow", {1.0f, 1.0f, 1.0f}, Of::kGlow},
                                {"RedGlow", {1.0f, 0.0f, 0.0f}, Of::kGlow},
                                {"GreenGlow", {0.0f, 1.0f, 0.0f}, Of::kGlow},
                                {"BlueGlow", {0.0f, 0.0f, 1.0f}, Of::kGlow},
                                {"YellowGlow", {1.0f, 1.0f, 0.0f}, Of::kGlow},
                                {"PurpleGlow", {1.0f, 0.0f, 1.0f}, Of::kGlow},
                                {"TurquoiseGlow", {0.0f, 1.0f, 1.0f}, Of::kGlow},
                                {"LightOn", {0.0f, 1.0f, 0.0f}, Of::kGlow},
                                {"LightOff", {1.0f, 0.0f, 0.0f}, Of::kGlow},
                                {"RedTransparent", {1.0f, 0.0f, 0.0f}, Of::kPaint, 0.5f},
                                {"GreenTransparent", {0.0f, 1.0f, 0.0f}, Of::kPaint, 0.5f},
                                {"BlueTransparent", {0.0f, 0.0f, 1.0f}, Of::kPaint, 0.5f},
                                {"GreyTransparent", {0.5f, 0.5f, 0.5f}, Of::kPaint, 0.5f},
                                {"YellowTransparent", {1.0f, 1.0f, 0.0f}, Of::kPaint, 0.5f},
                                {"OrangeTransparent", {1.0f, 0.44f, 0.0f}, Of::kPaint, 0.4f},
                                {"BlueLaser", {0.0f, 0.0f, 1.0f}, Of::kPaint, 0.4f},
                                {"PioneerBody", {1.0f, 0.0f, 0.0f}, Of::kPicture},
                                {"Pioneer2Body", {0.68f, 0.0f, 0.0f}},
                                {"WindowFrame", {0.60f, 0.55f, 0.50f}, Of::kPicture},
                                {"Motorway", {0.32f, 0.32f, 0.32f}, Of::kPicture},
                                {"Primary", {0.32f, 0.32f, 0.32f}, Of::kPicture},
                                {"Secondary", {0.32f, 0.32f, 0.32f}, Of::kPicture},
                                {"Tertiary", {0.35f, 0.35f, 0.35f}, Of::kPicture},
                                {"Trunk", {0.32f, 0.32f, 0.32f}, Of::kPicture},
                                {"Lanes_6", {0.32f, 0.32f, 0.32f}, Of::kPicture},
                                {"Lanes_4", {0.32f, 0.32f, 0.32f}, Of::kPicture},
                                {"Lanes_2", {0.32f, 0.32f, 0.32f}, Of::kPicture},
                                {"Lane_1", {0.32f, 0.32f, 0.32f}, Of::kPicture},
                                {"Footway", {0.55f, 0.52f, 0.50f}, Of::kPicture},
                                {"Steps", {0.55f, 0.52f, 0.50f}, Of::kPicture},
                                {"Runway", {0.30f, 0.30f, 0.30f}, Of::kPicture}};

/// What OGRE can do and we do not.
const std::set<std::string> kLost = {
    "vertex_program_ref", "fragment_program_ref", "rtshader_system", "env_map", "scroll",
    "scroll_anim",        "rotate_anim",          "wave_xform",      "rotate",  "cull_hardware",
    "cull_software",      "tex_address_mode",     "tex_coord_set"};

using Lines = std::vector<ScriptWords>;

std::optional<float> numberOf(const std::string& word) {
  std::istringstream stream(word);
  float number;
  if (!(stream >> number)) return std::nullopt;
  return number;
}

std::optional<LinearRgb> colorOf(const ScriptWords& words) {
  if (words.size() < 4) return std::nullopt;
  std::array<float, 3> display{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::optional<float> channel = numberOf(words[i + 1]);
    if (!channel) return std::nullopt;
    display[i] = *channel;
  }
  return linearFromSrgb(display);
}

/// OGRE's `alpha_op_ex source1 src_manual OTHER VALUE`: the value; none for other operations.
std::optional<float> manualAlpha(const ScriptWords& words) {
  if (words.size() < 5 || words[1] != "source1" || words[2] != "src_manual") return std::nullopt;
  return numberOf(words[4]);
}

/// OGRE's `scene_blend alpha_blend`, or the same in full.
bool blendsByAlpha(const ScriptWords& words) {
  const auto word = [&](std::size_t i) {
    return i < words.size() && words[i] != "}" ? words[i] : std::string();
  };
  return (word(1) == "alpha_blend" && word(2).empty()) ||
         (word(1) == "src_alpha" && word(2) == "one_minus_src_alpha");
}

/// OGRE's `scale U V`; none for what is no size.
std::optional<Eigen::Array2f> scaleOf(const ScriptWords& words) {
  if (words.size() < 3) return std::nullopt;
  const Eigen::Array2f scale(numberOf(words[1]).value_or(0.0f), numberOf(words[2]).value_or(0.0f));
  constexpr float kSmallest = 1e-4f;  // a texture that is repeated more often is noise
  if (!(scale.abs() > kSmallest).all() || !scale.isFinite().all()) return std::nullopt;
  return scale;
}

/// Whether OGRE's `colour_op` or `colour_op_ex` has a texture multiply what it lies on, as without either.
bool multiplies(const ScriptWords& words) {
  if (words.size() < 2 || words[1] != "modulate") return false;
  if (words[0] == "colour_op") return true;
  if (words.size() < 4) return false;
  const std::string& other = words[words[2] == "src_texture" ? 3 : 2];
  return (words[2] == "src_texture" || words[3] == "src_texture") &&
         (other == "src_current" || other == "src_diffuse");
}

/// OGRE's `colour_op_ex source1 src_manual OTHER R G B`, a plain colour; none for other operations.
std::optional<LinearRgb> manualColor(const ScriptWords& words) {
  if (words.size() < 7 || words[0] != "colour_op_ex" || words[1] != "source1" || words[2] != "src_manual")
    return std::nullopt;
  return colorOf({words.begin() + 3, words.end()});
}

/// A texture unit: its pass, and its place in that, from 0.
using Unit = std::pair<int, int>;

/// A material on the way, and in which of its passes and texture units.
struct Reading {
  ScriptMaterial material;
  int passes = 0;
  int units = 0;
  int units_of_pass = 0;
  std::optional<int> diffuse_pass = std::nullopt;  ///< that of the diffuse colour
  std::set<int> texture_passes = {};               ///< those with the texture
  std::set<int> plain_passes = {};                 ///< those whose texture no diffuse colour multiplies
  std::vector<std::pair<Unit, std::string>> textures = {};
  std::set<Unit> normal_maps = {};                     ///< of shaders
  std::optional<LinearRgb> unit_color = std::nullopt;  ///< of a texture unit that is a plain colour

  /// Where a parent gives one of the two, it is of the same pass.
  bool tints() const {
    if (!diffuse_pass || texture_passes.empty()) return plain_passes.empty();
    return texture_passes.count(*diffuse_pass) == 1 && plain_passes.count(*diffuse_pass) == 0;
  }
};

/// Where in the script the reading is, and what is between the diffuse colour and the texture.
void readPass(const ScriptWords& words, Reading& reading) {
  if (words[0] == "technique" || words[0] == "pass" || words[0] == "texture_unit") {
    const std::size_t colon =
        words.size() > 1 && words[1] != ":" && words[1] != "{" ? 2 : 1;  // behind a name
    if (colon + 1 < words.size() && words[colon] == ":")
      reading.material.lost.insert("what its " + words[0] + " has of " + words[colon + 1]);
  }
  if (words[0] == "pass") {
    ++reading.passes;
    reading.units_of_pass = 0;
  }
  if (words[0] == "texture_unit") {
    ++reading.units;
    ++reading.units_of_pass;
  }
  if (words[0] == "lighting" && words.size() > 1 && words[1] == "off")
    reading.plain_passes.insert(reading.passes);
  if ((words[0] == "colour_op" || words[0] == "colour_op_ex") && !multiplies(words)) {
    if (const std::optional<LinearRgb> color = manualColor(words))
      reading.unit_color = color;
    else
      reading.material.lost.insert(words[0]);
    if (reading.units_of_pass == 1) reading.plain_passes.insert(reading.passes);
  }
}

/// OGRE's `param_named NAME TYPE VALUE` of a shader, which may stand before or behind what it is about.
void readParameter(const ScriptWords& words, Reading& reading) {
  if (words.size() < 4) return;
  std::string name = words[1];
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
  const auto says = [&](const char* word) { return name.find(word) != std::string::npos; };
  const std::optional<float> unit = words[2] == "int" ? numberOf(words[3]) : std::nullopt;
  if (unit && (says("bump") || says("normal")))
    reading.normal_maps.insert({reading.passes, static_cast<int>(*unit)});
  if (says("color") || says("colour")) reading.material.lost.insert(words[1] + ", a colour of a shader");
}

/// The first texture that is a colour; others are named.
void takeTextures(Reading& reading) {
  std::optional<std::string>& texture = reading.material.texture;
  for (const auto& [unit, name] : reading.textures) {
    if (reading.normal_maps.count(unit) > 0) {
      reading.material.lost.insert("texture " + name + ", a normal map of a shader");
      if (unit == reading.textures.front().first) reading.material.texture_scale.reset();
      continue;
    }
    if (!texture) texture = name;
    if (name == *texture)
      reading.texture_passes.insert(unit.first);
    else
      reading.material.lost.insert("texture " + name);
  }
}

/// Without a texture, a unit's plain colour lies on all that there is.
void takeUnitColor(Reading& reading) {
  if (!reading.unit_color) return;
  if (!reading.textures.empty()) reading.material.lost.insert("colour_op_ex");
  if (reading.textures.empty()) reading.material.diffuse = reading.unit_color;
}

void nameUnsetVariables(const ScriptWords& line, ScriptMaterial& material) {
  for (std::size_t i = 1; i < line.size(); ++i) {
    if (line[i].compare(0, 1, "$") == 0 && line[i - 1] != "set")
      material.lost.insert("variable " + line[i] + ", which is not set before");
  }
}

/// One line, or several written as one: a keyword may follow a brace.
void readLine(const ScriptWords& line, Reading& reading) {
  ScriptMaterial& material = reading.material;
  nameUnsetVariables(line, material);
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (i > 0 && line[i - 1] != "{" && line[i - 1] != "}") continue;
    const ScriptWords words(line.begin() + static_cast<std::ptrdiff_t>(i), line.end());
    if (words[0] == "diffuse" && !material.diffuse) {
      material.diffuse = colorOf(words);
      if (material.diffuse)
        reading.diffuse_pass = reading.passes;
      else  // that of the vertices
        reading.plain_passes.insert(reading.passes);
      if (words.size() > 4) material.opacity = std::clamp(numberOf(words[4]).value_or(1.0f), 0.0f, 1.0f);
    }
    readPass(words, reading);
    if (words[0] == "scale") {
      const std::optional<Eigen::Array2f> scale = reading.units == 1 ? scaleOf(words) : std::nullopt;
      if (scale) material.texture_scale = *scale;
      if (!scale) material.lost.insert(words[0]);
    }
    if (words[0] == "alpha_op_ex") {
      const std::optional<float> alpha = manualAlpha(words);
      if (alpha) material.opacity = std::clamp(*alpha, 0.0f, 1.0f);
      if (!alpha) material.lost.insert(words[0]);
    }
    if (words[0] == "scene_blend") {
      const bool by_alpha = blendsByAlpha(words);
      material.blends |= by_alpha;
      if (!by_alpha) material.lost.insert(words[0]);
    }
    if (words[0] == "texture" && words.size() > 1)
      reading.textures.push_back({{reading.passes, reading.units_of_pass - 1}, words[1]});
    if (words[0] == "param_named") readParameter(words, reading);
    if (words[0] == "alpha_rejection" && words.size() > 1 && words[1] != "always_pass")
      material.alpha_rejection = true;
    if (words[0] == "emissive" && !material.emissive) material.emissive = colorOf(words);
    if (kLost.count(words[0]) > 0) material.lost.insert(words[0]);
  }
}

/// What a material takes from its parent where it does not set it.
void inherit(const ScriptMaterial& parent, ScriptMaterial* material) {
  if (!material->diffuse) {
    material->diffuse = parent.diffuse;
    material->opacity = std::min(material->opacity, parent.opacity);
  }
  if (!material->texture) {
    material->texture = parent.texture;
    material->texture_from = parent.texture_from;
    if (!material->texture_scale) material->texture_scale = parent.texture_scale;
  }
  material->tints = material->tints && parent.tints;
  material->blends = material->blends || parent.blends;
  material->alpha_rejection = material->alpha_rejection || parent.alpha_rejection;
  if (!material->emissive) material->emissive = parent.emissive;
  material->lost.insert(parent.lost.begin(), parent.lost.end());
}

std::optional<ScriptMaterial> comesWithGazebo(const std::string& name) {
  const std::optional<GazeboLook> look = gazeboLook(name);
  if (!look) return std::nullopt;
  ScriptMaterial material;
  material.diffuse = look->color;
  material.tints = !look->pictured;
  material.emissive = look->emissive;
  material.blends = look->opacity < 1.0f;
  material.opacity = look->opacity;
  return material;
}

/// A script, and what is not in it.
struct Script {
  const Lines& lines;
  const ScriptOf& elsewhere;
};

/// The material `name` of the first `end` lines. In one script a parent is looked for above its child only,
/// so that a circle cannot be.
std::optional<ScriptMaterial> materialIn(const Script& script, std::size_t end, const std::string& name) {
  std::optional<Reading> reading;
  std::optional<ScriptMaterial> parent;
  int depth = 0;
  for (std::size_t i = 0; i < end; ++i) {
    const ScriptWords& words = script.lines[i];
    const bool starts = depth == 0 && words[0] == "material" && words.size() > 1;
    if (starts && reading) break;
    if (starts && words[1] == name) {
      reading.emplace();
      if (words.size() > 3 && words[2] == ":") {
        parent = materialIn(script, i, words[3]);
        if (!parent) parent = comesWithGazebo(words[3]);
        if (!parent && script.elsewhere) parent = script.elsewhere(words[3]);
        if (!parent) reading->material.lost.insert("its parent " + words[3] + ", which no script has");
      }
    }
    if (reading) readLine(words, *reading);
    for (const std::string& word : words) depth += word == "{" ? 1 : word == "}" ? -1 : 0;
    // What stands between two materials, such as an abstract pass, belongs to none.
    if (reading && depth == 0 && std::count(words.begin(), words.end(), "}") > 0) break;
  }
  if (!reading) return std::nullopt;
  takeTextures(*reading);
  takeUnitColor(*reading);
  reading->material.tints = reading->tints();
  if (parent) inherit(*parent, &reading->material);
  return reading->material;
}

}  // namespace

Material materialOf(const GazeboLook& look, const std::string& name) {
  Material material;
  material.name = name;
  material.base_color = look.color;
  material.emission.value = kDisplayWhite_cd_per_m2 * look.emissive.value;
  material.alpha_mode = AlphaMode::kBlend;  // opaque, where there is nothing to be seen through
  material.alpha = look.opacity;
  return material;
}

std::optional<GazeboLook> gazeboLook(const std::string& name) {
  const std::string prefix = "Gazebo/";
  if (name.compare(0, prefix.size(), prefix) != 0) return std::nullopt;
  for (const NamedLook& look : kLooks) {
    if (name.substr(prefix.size()) != look.name) continue;
    const LinearRgb color = linearFromSrgb(look.display);
    return GazeboLook{color, look.opacity, look.of == Of::kGlow ? color : LinearRgb(),
                      look.of == Of::kPicture};
  }
  return std::nullopt;
}

std::optional<ScriptMaterial> parseMaterialScript(const std::string& text, const std::string& name,
                                                  const ScriptOf& elsewhere) {
  const Lines lines = linesOfScript(text);
  return materialIn({lines, elsewhere}, lines.size(), name);
}

}  // namespace sunlit::scene
