#include "scene/gltf_lights.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <vector>

#include "scene/gltf_json.h"

namespace sunlit::scene {
namespace {

using nlohmann::json;

constexpr const char* kLights = "KHR_lights_punctual";
constexpr float kUsualOuter_rad = 0.785398163f;  ///< π/4
/// Deeper trees of nodes go in circles.
constexpr int kDeepest = 1000;

Eigen::Affine3d parentFrom(const json& node) {
  Eigen::Affine3d pose = Eigen::Affine3d::Identity();
  if (node.contains("matrix")) {
    const auto columns = node.at("matrix").get<std::array<double, 16>>();
    pose.matrix() = Eigen::Map<const Eigen::Matrix4d>(columns.data());
    return pose;
  }
  const auto move = node.value("translation", std::array<double, 3>{0.0, 0.0, 0.0});
  const auto turn = node.value("rotation", std::array<double, 4>{0.0, 0.0, 0.0, 1.0});  // x, y, z, w
  const auto scale = node.value("scale", std::array<double, 3>{1.0, 1.0, 1.0});
  pose.translate(Eigen::Vector3d(move[0], move[1], move[2]));
  pose.rotate(Eigen::Quaterniond(turn[3], turn[0], turn[1], turn[2]));
  pose.scale(Eigen::Vector3d(scale[0], scale[1], scale[2]));
  return pose;
}

/// Shines along −z of its node, which does not scale it.
Lamp lampOf(const json& light, const Eigen::Affine3d& up_from_node) {
  Lamp lamp;
  const auto color = light.value("color", std::array<float, 3>{1.0f, 1.0f, 1.0f});
  const float intensity = light.value("intensity", 1.0f);
  lamp.intensity = LinearRgb(color[0] * intensity, color[1] * intensity, color[2] * intensity);
  lamp.position = up_from_node.translation().cast<float>();
  lamp.range_m = light.value("range", lamp.range_m);
  if (light.value("type", "") != "spot") return lamp;
  lamp.direction = (-up_from_node.linear().col(2)).normalized().cast<float>();
  const json& spot = child(light, "spot");
  lamp.outer_rad = spot.value("outerConeAngle", kUsualOuter_rad);
  lamp.inner_rad = std::min(spot.value("innerConeAngle", 0.0f), lamp.outer_rad);
  return lamp;
}

class LampReader {
 public:
  LampReader(const json& root, SceneBuilder& builder)
      : nodes_(child(root, "nodes")), lights_(child(extension(root, kLights), "lights")), builder_(builder) {}

  void read(const json& node, const Eigen::Affine3d& up_from_parent, int depth) {
    if (depth > kDeepest) throw std::runtime_error("its nodes go in circles");
    const Eigen::Affine3d up_from_node = up_from_parent * parentFrom(node);
    const json& use = extension(node, kLights);
    if (use.contains("light")) add(lights_.at(indexOf(use.at("light"))), node, up_from_node);
    for (const json& index : child(node, "children"))
      read(nodes_.at(indexOf(index)), up_from_node, depth + 1);
  }

 private:
  void add(const json& light, const json& node, const Eigen::Affine3d& up_from_node) {
    const std::string type = light.value("type", "");
    const std::string name = node.value("name", light.value("name", ""));
    if (type != "point" && type != "spot") {
      builder_.warn(kOtherLights, name);
      return;
    }
    Lamp lamp = lampOf(light, up_from_node);
    lamp.name = name;
    lamp.group = light.value("name", name);  // those that share a light are switched together
    builder_.addLamp(std::move(lamp));
  }

  const json& nodes_;
  const json& lights_;
  SceneBuilder& builder_;
};

}  // namespace

void addGltfLights(const json& root, const std::string& file, const Eigen::Affine3d& up_from_file,
                   SceneBuilder& builder) {
  if (extension(root, kLights).empty()) return;
  try {
    LampReader reader(root, builder);
    const json& scenes = child(root, "scenes");
    if (scenes.empty()) return;
    const json& scene = scenes.at(indexOf(root, "scene", 0));
    for (const json& index : child(scene, "nodes"))
      reader.read(child(root, "nodes").at(indexOf(index)), up_from_file, 0);
  } catch (const std::exception& error) {
    throw std::runtime_error(file + ": its lights: " + error.what());
  }
}

}  // namespace sunlit::scene
