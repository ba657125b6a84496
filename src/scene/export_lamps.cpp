#include "scene/export_lamps.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "scene/export_json.h"
#include "sunlit/quantity/turn.h"

namespace sunlit::scene {
namespace {

constexpr float kWidestCone_rad = 1.5707962f;  // at most π/2, by the extension

/// cd of the inverse square that stands for the lamp's own fall-off.
Eigen::Array3f inverseSquare(const Lamp& lamp, ExportLosses* losses) {
  if (lamp.constant == 0.0f && lamp.linear == 0.0f) return lamp.intensity.value / lamp.quadratic;
  losses->add(
      "lamps fall off otherwise than with the square of the distance, they are as bright on the ground below "
      "(z = 0, 1 to 20 m away) and brighter near by",
      lamp.name);
  const float d = std::min(std::clamp(lamp.position.z(), 1.0f, 20.0f), 0.5f * lamp.range_m);
  const float part = d / lamp.range_m, window = lamp.ends_sharply ? 1.0f - std::pow(part, 4.0f) : 1.0f;
  return lamp.intensity.value / window * (d * d / (lamp.constant + lamp.linear * d + lamp.quadratic * d * d));
}

std::string spotJson(const Lamp& lamp, ExportLosses* losses) {
  if (lamp.outer_rad > kWidestCone_rad)
    losses->add("lamps have cones wider than a half space, they are cut off there", lamp.name);
  const float outer = std::min(lamp.outer_rad, kWidestCone_rad);
  // The extension wants it below the outer one.
  const float inner = std::min(lamp.inner_rad, std::nextafter(outer, 0.0f));
  if (lamp.exponent != 2.0f && lamp.inner_rad < lamp.outer_rad)
    losses->add("lamps fade towards the edge of their cones otherwise than with the square", lamp.name);
  return ",\"spot\":{\"innerConeAngle\":" + number(inner) + ",\"outerConeAngle\":" + number(outer) + "}";
}

}  // namespace

std::string lightJson(const Lamp& lamp, ExportLosses* losses) {
  const Eigen::Array3f intensity = inverseSquare(lamp, losses);
  const float strength = intensity.maxCoeff();
  const Eigen::Array3f color = strength > 0.0f ? Eigen::Array3f(intensity / strength) : intensity;
  if (lamp.radius_m != Lamp::kUsualRadius_m)
    losses->add("lamps have a size of their own, by which shadows are softer or harder", lamp.name);
  if (!lamp.casts_shadows) losses->add("lamps cast no shadows here, elsewhere they may", lamp.name);
  std::string json = "{\"type\":\"" + std::string(lamp.isSpot() ? "spot" : "point") + "\"";
  if (!lamp.group.empty()) json += ",\"name\":" + jsonString(lamp.group);
  json += ",\"color\":" + vector3(color) + ",\"intensity\":" + number(strength);
  if (lamp.ends_sharply && std::isfinite(lamp.range_m))
    losses->add("lamps end sharply at their range, they fade towards it", lamp.name);
  if (std::isfinite(lamp.range_m)) json += ",\"range\":" + number(lamp.range_m);
  if (lamp.isSpot()) json += spotJson(lamp, losses);
  return json + "}";
}

std::string lampNodeJson(const Lamp& lamp, std::size_t index) {
  const Eigen::Vector3d ahead = yUp(lamp.direction).cast<double>();
  const Eigen::Quaternionf turn = turnBetween(-Eigen::Vector3d::UnitZ(), ahead).cast<float>();
  return "{\"name\":" + jsonString(lamp.name) + ",\"translation\":" + vector3(yUp(lamp.position)) +
         ",\"rotation\":" +
         jsonArray({number(turn.x()), number(turn.y()), number(turn.z()), number(turn.w())}) +
         ",\"extensions\":{\"KHR_lights_punctual\":{\"light\":" + std::to_string(index) + "}}}";
}

}  // namespace sunlit::scene
