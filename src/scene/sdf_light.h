/// The lights of SDF worlds and links as lamps.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <sdf/Light.hh>
#include <string>

#include "scene/scene_builder.h"
#include "sunlit/scene/scene.h"

namespace sunlit::scene {

/// How a light goes by in messages, and the lamps that are switched with it.
struct LightName {
  std::string name, group;
};

/// A light whose own frame stands at `map_from_light`. SDF gives colours without a unit, as the screen shows
/// them: the lamp is relative. Nothing for a directional light, which is Gazebo's sun, in whose place stands
/// ours, and for one that cannot shine; both are warnings of `builder`.
std::optional<Lamp> lampOf(const sdf::Light& light, const Eigen::Affine3d& map_from_light,
                           const LightName& name, SceneBuilder& builder);

}  // namespace sunlit::scene
