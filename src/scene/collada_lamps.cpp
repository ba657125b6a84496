#include "scene/collada_lamps.h"

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "scene/assimp_nodes.h"
#include "scene/color.h"

namespace sunlit::scene {
namespace {

/// COLLADA gives colours without a unit, whole cones, and attenuation by distances in the unit of the file,
/// of `unit_m`.
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
  lamp.outer_rad = std::clamp(0.5f * light.mAngleOuterCone, 0.0f, Lamp::kAllAround_rad);
  lamp.inner_rad = std::clamp(0.5f * light.mAngleInnerCone, 0.0f, lamp.outer_rad);
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
