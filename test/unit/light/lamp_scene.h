/// A floor by night under lamps.
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <utility>
#include <vector>

#include "paper_scene.h"

namespace sunlit::light {

inline scene::Lamp lampAt(const Eigen::Vector3f& position, float cd = 100.0f) {
  scene::Lamp lamp;
  lamp.name = "lamp";
  lamp.position = position;
  lamp.intensity = LinearRgb(cd, cd, cd);
  return lamp;
}

/// A matt floor of 100 m, black, so that no ray but the lamps' matters, at night.
inline World floorWorld() {
  scene::Scene scene;
  scene.materials = {paint(0.5f), paint(0.0f)};
  addGround(&scene, 0, 100.0f);
  return worldOf(std::move(scene));
}

inline Looked floorAt(float x, float y = 0.0f) {
  const Eigen::Vector3f up = Eigen::Vector3f::UnitZ();
  return {{x, y, 0.0f}, up, up, 0};
}

/// The luminance of points of `world` by nothing but `lamps`.
inline std::vector<double> lit(const World& world, const std::vector<scene::Lamp>& lamps,
                               const std::vector<Looked>& points) {
  Illumination light(uniformDay(0.0f));
  light.lamps = std::make_shared<const std::vector<scene::Lamp>>(lamps);
  return rowValues(rowOf(points, *world.geometry->scene), world, light);
}

}  // namespace sunlit::light
