#include "scene/collada_lamps.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <vector>

#include "scene/assimp_nodes.h"
#include "scene/collada_tags.h"
#include "scene/color.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::scene {
namespace {

/// Elements of extensions by which Assimp has a second angle of a cone.
bool isOuterAngle(const std::string& name) {
  return name == "outer_cone" || name == "falloff" || name == "decay_falloff" || name == "penumbra_angle";
}

/// What nodes and lights are called in the text.
struct Names {
  std::set<std::string> of_nodes;
  std::map<std::string, std::string> of_lights;  ///< by id

  /// The first that no node has, by whose name Assimp tells where a lamp stands; empty where there is none.
  std::string ofLamp(const std::string& node_tag, const std::string& instance_tag) const {
    const std::string light = withoutHash(valueInTag(instance_tag, "url"));
    const auto called = of_lights.find(light);
    for (const std::string& name :
         {valueInTag(node_tag, "id"), called == of_lights.end() ? "" : called->second, light}) {
      if (!name.empty() && of_nodes.count(name) == 0) return name;
    }
    return "";
  }
};

Names namesIn(const std::string& text) {
  Names names;
  forEachTag(text, [&](const std::string& name, const std::string& tag, std::size_t) {
    if (name == "node" || name == "visual_scene") names.of_nodes.insert(valueInTag(tag, "name"));
    if (name == "light") names.of_lights[valueInTag(tag, "id")] = valueInTag(tag, "name");
  });
  return names;
}

/// One without a name, or with an empty one.
void nameNode(const std::string& tag, std::size_t at, std::string name, TextChanges* changes) {
  for (std::size_t quote = name.find('"'); quote != std::string::npos; quote = name.find('"'))
    name.replace(quote, 1, "&quot;");
  const std::size_t place = placeInTag(tag, "name").first, behind_node = std::string("<node").size();
  name = '"' + name + '"';
  if (place == std::string::npos)
    (*changes)[at + behind_node] = {0, " name=" + name};
  else
    (*changes)[at + place - 1] = {2, name};
}

/// A <spot>, as it stands in the text.
struct SpotText {
  std::size_t behind_tag = 0;  ///< 0: there is none
  float exponent = 0.0f;
  bool has_outer_angle = false;
};

/// Has Assimp take the exponent of the spot for a second angle, which nobody has below 0.
void handOnExponent(const SpotText& spot, TextChanges* changes) {
  if (spot.behind_tag > 0 && !spot.has_outer_angle)
    (*changes)[spot.behind_tag] = {0, "<outer_cone>" + std::to_string(-spot.exponent) + "</outer_cone>"};
}

/// COLLADA has whole angles, a light that falls off as cosⁿ of the angle to the axis, and nothing beyond the
/// cone, as OpenGL. Here the falloff goes on to 0 at its edge, with as much light in all: that of n = 0, and
/// of a cone of a half space, is the same.
void readCone(const aiLight& light, Lamp* lamp) {
  const auto half = [](float angle) { return std::clamp(0.5f * angle, 0.0f, Lamp::kAllAround_rad); };
  lamp->outer_rad = lamp->inner_rad = half(light.mAngleInnerCone);
  if (light.mAngleOuterCone > 0.0f) {  // of an extension
    lamp->outer_rad = half(light.mAngleOuterCone);
    lamp->inner_rad = std::min(lamp->inner_rad, lamp->outer_rad);
    return;
  }
  const double exponent = -Angle::radians(static_cast<double>(light.mAngleOuterCone)).deg();
  if (exponent <= 0.0) return;
  lamp->inner_rad = 0.0f;
  lamp->outer_rad = std::min(lamp->outer_rad, 0.5f * kPiFloat);
  // Of the flux ∫ cosⁿ d(cos) from the axis to the edge, by 1 − cos: narrow cones have cosines near 1.
  const double sine = std::sin(0.5 * static_cast<double>(lamp->outer_rad));
  const double width = std::min(2.0 * sine * sine, 1.0);
  const double flux = -std::expm1((exponent + 1.0) * std::log1p(-width)) / (exponent + 1.0);
  lamp->exponent = static_cast<float>(std::clamp(width / flux - 1.0, 0.0, 100.0));
}

/// COLLADA gives colours without a unit, and attenuation by distances in the unit of the file, of `unit_m`.
Lamp lampOf(const aiLight& light, const Eigen::Affine3d& up_from_node, float unit_m) {
  Lamp lamp;
  lamp.name = lamp.group = light.mName.C_Str();
  lamp.relative = true;
  const aiColor3D& color = light.mColorDiffuse;
  lamp.intensity = linearFromBright({color.r, color.g, color.b});
  const aiVector3D &at = light.mPosition, &to = light.mDirection;
  lamp.position = (up_from_node * Eigen::Vector3d(at.x, at.y, at.z)).cast<float>();
  lamp.constant = light.mAttenuationConstant;
  lamp.linear = light.mAttenuationLinear / unit_m;
  lamp.quadratic = light.mAttenuationQuadratic / (unit_m * unit_m);
  if (light.mType != aiLightSource_SPOT) return lamp;
  lamp.direction = (up_from_node.linear() * Eigen::Vector3d(to.x, to.y, to.z)).normalized().cast<float>();
  readCone(light, &lamp);
  return lamp;
}

bool isLamp(const aiLight& light) {
  return light.mType == aiLightSource_POINT || light.mType == aiLightSource_SPOT;
}

/// By which its root node scales it.
float unitOf(const aiScene& scene) {
  const double unit_m = toEigen(scene.mRootNode->mTransformation).linear().col(0).norm();
  return unit_m > 0.0 ? static_cast<float>(unit_m) : 1.0f;
}

/// Where lights stand, which Assimp tells by nothing but the names of their nodes.
class Places {
 public:
  explicit Places(const aiScene& scene) {
    addNodes(*scene.mRootNode);
    for (unsigned i = 0; i < scene.mNumLights; ++i) ++by_name_[scene.mLights[i]->mName.C_Str()].lights;
  }

  /// Null where it stands nowhere. To be asked once for each light, in their order.
  const aiNode* nextOf(const aiLight& light) {
    Place& place = by_name_[light.mName.C_Str()];
    if (place.nodes.empty()) return nullptr;
    return isSettled(light) && place.nodes.size() > 1 ? place.nodes[place.asked++] : place.nodes.front();
  }

  /// Whether there is no doubt about its node.
  bool isSettled(const aiLight& light) const {
    const Place& place = by_name_.at(light.mName.C_Str());
    return place.nodes.size() < 2 || place.nodes.size() == place.lights;
  }

 private:
  struct Place {
    std::vector<const aiNode*> nodes;
    std::size_t lights = 0, asked = 0;
  };

  /// In the order in which Assimp makes their lights: a node's after those below it.
  void addNodes(const aiNode& node) {
    for (unsigned i = 0; i < node.mNumChildren; ++i) addNodes(*node.mChildren[i]);
    by_name_[node.mName.C_Str()].nodes.push_back(&node);
  }

  std::map<std::string, Place> by_name_;
};

}  // namespace

std::string withNamesOfLamps(const std::string& text) {
  const Names names = namesIn(text);
  TextChanges changes;
  std::string node;
  std::size_t node_at = 0;
  forEachTag(text, [&](const std::string& name, const std::string& tag, std::size_t at) {
    if (name == "node") {
      node = tag;
      node_at = at;
    }
    // Lights stand before the nodes below theirs.
    if (name != "instance_light" || node.empty() || !valueInTag(node, "name").empty()) return;
    const std::string called = names.ofLamp(node, tag);
    if (!called.empty()) nameNode(node, node_at, called, &changes);
  });
  return changed(text, changes);
}

std::string withExponentsOfSpots(const std::string& text) {
  constexpr float kMost = 1000.0f;  // narrower than any cone
  TextChanges changes;
  SpotText spot;
  forEachTag(text, [&](const std::string& name, const std::string& tag, std::size_t at) {
    if (name == "light" || name.compare(0, 8, "library_") == 0) {
      handOnExponent(spot, &changes);
      spot = {};
    }
    if (name == "spot") spot.behind_tag = at + tag.size();
    if (name == "falloff_exponent") {
      const float exponent = std::strtof(contentBehind(at + tag.size(), text).c_str(), nullptr);
      spot.exponent = std::min(std::max(0.0f, exponent), kMost);  // 0 for NaN
    }
    spot.has_outer_angle = spot.has_outer_angle || isOuterAngle(name);
  });
  handOnExponent(spot, &changes);
  return changed(text, changes);
}

void addColladaLamps(const aiScene& scene, const Eigen::Affine3d& up_from_file, SceneBuilder& builder) {
  Places places(scene);
  for (unsigned i = 0; i < scene.mNumLights; ++i) {
    const aiLight& light = *scene.mLights[i];
    const aiNode* const node = places.nextOf(light);
    if (!isLamp(light)) {
      builder.warn(kOtherLights, light.mName.C_Str());
      continue;
    }
    if (node == nullptr) continue;
    if (!places.isSettled(light))
      builder.warn("lamps share their names with other nodes, they stand where the first of these does",
                   light.mName.C_Str());
    builder.addLamp(lampOf(light, up_from_file * fileFromNode(*node), unitOf(scene)));
  }
}

std::size_t lampsIn(const aiScene& scene) {
  return static_cast<std::size_t>(std::count_if(scene.mLights, scene.mLights + scene.mNumLights,
                                                [](const aiLight* light) { return isLamp(*light); }));
}

}  // namespace sunlit::scene
