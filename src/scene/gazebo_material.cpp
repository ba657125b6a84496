#include "scene/gazebo_material.h"

#include <array>
#include <cstddef>
#include <sstream>
#include <utility>
#include <vector>

#include "scene/color.h"

namespace sunlit::scene {
namespace {

struct NamedColor {
  const char* name;
  std::array<float, 3> display;  ///< as on a screen
};

/// Diffuse colours of Gazebo's own materials; those with a picture by a colour that looks like it.
constexpr std::array<NamedColor, 37> kColors = {{{"Grey", {0.7f, 0.7f, 0.7f}},
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
                                                 {"Wood", {0.55f, 0.42f, 0.28f}},
                                                 {"WoodFloor", {0.60f, 0.45f, 0.30f}},
                                                 {"WoodPallet", {0.62f, 0.48f, 0.32f}},
                                                 {"Bricks", {0.58f, 0.33f, 0.26f}},
                                                 {"CeilingTiled", {0.80f, 0.80f, 0.78f}},
                                                 {"PaintedWall", {0.78f, 0.76f, 0.70f}},
                                                 {"CloudySky", {0.60f, 0.70f, 0.80f}},
                                                 {"Grass", {0.30f, 0.42f, 0.18f}},
                                                 {"Road", {0.32f, 0.32f, 0.32f}},
                                                 {"Asphalt", {0.30f, 0.30f, 0.30f}},
                                                 {"Residential", {0.35f, 0.35f, 0.35f}},
                                                 {"Pedestrian", {0.55f, 0.52f, 0.50f}},
                                                 {"Rocky", {0.45f, 0.42f, 0.38f}},
                                                 {"Chrome", {0.75f, 0.75f, 0.75f}}}};

/// What OGRE can do and we do not.
const std::set<std::string> kLost = {"scene_blend",
                                     "vertex_program_ref",
                                     "fragment_program_ref",
                                     "rtshader_system",
                                     "env_map",
                                     "scroll",
                                     "scroll_anim",
                                     "rotate_anim",
                                     "wave_xform",
                                     "rotate",
                                     "scale",
                                     "colour_op",
                                     "colour_op_ex",
                                     "cull_hardware",
                                     "cull_software",
                                     "tex_address_mode",
                                     "tex_coord_set"};

using Words = std::vector<std::string>;
using Lines = std::vector<Words>;

/// Words and braces of a script, a line at a time, without comments.
Lines linesOf(const std::string& text) {
  Lines lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    line = line.substr(0, line.find("//"));
    std::string spaced;
    for (const char letter : line) {
      const bool brace = letter == '{' || letter == '}';
      spaced += brace ? std::string(" ") + letter + " " : std::string(1, letter);
    }
    std::istringstream words(spaced);
    Words split;
    for (std::string word; words >> word;) split.push_back(word);
    if (!split.empty()) lines.push_back(std::move(split));
  }
  return lines;
}

std::optional<LinearRgb> colorOf(const Words& words) {
  if (words.size() < 4) return std::nullopt;
  std::array<float, 3> display{};
  for (std::size_t i = 0; i < 3; ++i) {
    std::istringstream number(words[i + 1]);
    if (!(number >> display[i])) return std::nullopt;
  }
  return linearFromSrgb(display);
}

/// One line, or several written as one: a keyword may follow a brace.
void readLine(const Words& line, ScriptMaterial& material) {
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (i > 0 && line[i - 1] != "{" && line[i - 1] != "}") continue;
    const Words words(line.begin() + static_cast<std::ptrdiff_t>(i), line.end());
    if (words[0] == "diffuse" && !material.diffuse) material.diffuse = colorOf(words);
    if (words[0] == "texture" && words.size() > 1 && !material.texture) material.texture = words[1];
    if (words[0] == "alpha_rejection") material.alpha_rejection = true;
    if (words[0] == "emissive" && !material.emissive) material.emissive = colorOf(words);
    if (kLost.count(words[0]) > 0) material.lost.insert(words[0]);
    if (words[0] == "texture" && words.size() > 1 && material.texture && words[1] != *material.texture)
      material.lost.insert("texture " + words[1]);
  }
}

/// The material `name` of the first `end` lines. OGRE wants a parent before its child, so it is looked for
/// above only, and a circle cannot be.
std::optional<ScriptMaterial> materialIn(const Lines& lines, std::size_t end, const std::string& name) {
  std::optional<ScriptMaterial> material;
  std::optional<ScriptMaterial> inherited;
  int depth = 0;
  for (std::size_t i = 0; i < end; ++i) {
    const Words& words = lines[i];
    const bool starts = depth == 0 && words[0] == "material" && words.size() > 1;
    if (starts && material) break;
    if (starts && words[1] == name) {
      material.emplace();
      if (words.size() > 3 && words[2] == ":") inherited = materialIn(lines, i, words[3]);
    } else if (material) {
      readLine(words, *material);
    }
    for (const std::string& word : words) depth += word == "{" ? 1 : word == "}" ? -1 : 0;
  }
  if (!material || !inherited) return material;
  if (!material->diffuse) material->diffuse = inherited->diffuse;
  if (!material->texture) material->texture = inherited->texture;
  material->alpha_rejection = material->alpha_rejection || inherited->alpha_rejection;
  if (!material->emissive) material->emissive = inherited->emissive;
  material->lost.insert(inherited->lost.begin(), inherited->lost.end());
  return material;
}

}  // namespace

std::optional<LinearRgb> gazeboColor(const std::string& name) {
  const std::string prefix = "Gazebo/";
  if (name.compare(0, prefix.size(), prefix) != 0) return std::nullopt;
  for (const NamedColor& color : kColors) {
    if (name.substr(prefix.size()) == color.name) return linearFromSrgb(color.display);
  }
  return std::nullopt;
}

std::optional<ScriptMaterial> parseMaterialScript(const std::string& text, const std::string& name) {
  const Lines lines = linesOf(text);
  return materialIn(lines, lines.size(), name);
}

}  // namespace sunlit::scene
