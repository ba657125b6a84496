#include "scene/sdf_light.h"

#include <algorithm>
#include <cmath>

#include "scene/color.h"
#include "scene/sdf_library.h"
#include "scene/sdf_pose.h"

namespace sunlit::scene {
namespace {

LinearRgb intensityOf(const sdf::Light& light) {
  const ignition::math::Color color = light.Diffuse();
  LinearRgb linear = linearFromSrgb({color.R(), color.G(), color.B()});
  linear.value *= static_cast<float>(strengthOf(light));
  return linear;
}

bool isFinite(const sdf::Light& light) {
  double sum = strengthOf(light) + light.AttenuationRange() + light.ConstantAttenuationFactor() +
               light.LinearAttenuationFactor() + light.QuadraticAttenuationFactor();
  if (light.Type() == sdf::LightType::SPOT)
    sum += light.SpotInnerAngle().Radian() + light.SpotOuterAngle().Radian() + light.SpotFalloff();
  return std::isfinite(sum) && light.Direction().IsFinite();
}

/// SDF's angles are those of whole cones.
void readCone(const sdf::Light& light, const Eigen::Affine3d& map_from_light, Lamp* lamp) {
  const Eigen::Vector3d direction = map_from_light.linear() * toEigen(light.Direction());
  lamp->direction = direction.normalized().cast<float>();
  const auto half = [](double angle) {
    return std::clamp(static_cast<float>(0.5 * angle), 0.0f, Lamp::kAllAround_rad);
  };
  lamp->outer_rad = half(light.SpotOuterAngle().Radian());
  lamp->inner_rad = std::min(half(light.SpotInnerAngle().Radian()), lamp->outer_rad);
  lamp->exponent = std::clamp(static_cast<float>(light.SpotFalloff()), 0.0f, 100.0f);
}

}  // namespace

std::optional<Lamp> lampOf(const sdf::Light& light, const Eigen::Affine3d& map_from_light,
                           const LightName& name, SceneBuilder& builder) {
  if (light.Type() == sdf::LightType::DIRECTIONAL) {
    builder.warn("directional lights were not read: the sun of the sky takes their place", name.name);
    return std::nullopt;
  }
  const sdf::ElementPtr on = light.Element() ? firstIn(*light.Element(), "light_on") : nullptr;
  if (on && !on->Get<bool>()) {
    builder.warn("lights are switched off by <light_on> and were left out", name.name);
    return std::nullopt;
  }
  const bool spot = light.Type() == sdf::LightType::SPOT;
  const auto factor = [](double value) { return std::max(static_cast<float>(value), 0.0f); };
  Lamp lamp;
  lamp.name = name.name;
  lamp.group = name.group;
  lamp.position = map_from_light.translation().cast<float>();
  lamp.relative = true;
  lamp.intensity = intensityOf(light);
  lamp.range_m = static_cast<float>(light.AttenuationRange());
  lamp.ends_sharply = true;
  lamp.constant = factor(light.ConstantAttenuationFactor());
  lamp.linear = factor(light.LinearAttenuationFactor());
  lamp.quadratic = factor(light.QuadraticAttenuationFactor());
  lamp.casts_shadows = light.CastShadows();
  if (spot) readCone(light, map_from_light, &lamp);
  if (isFinite(light) && canShine(lamp)) return lamp;
  builder.warn(kDarkLights, name.name);
  return std::nullopt;
}

}  // namespace sunlit::scene
