/// One condition's light, as far as it does not depend on the camera: made when sun or moon moved, used for
/// many pictures.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "sunlit/light/lamps.h"
#include "sunlit/sky/daylight.h"

namespace sunlit::light {

class AroundLight;
struct GlintNodes;
class MirrorSky;
class NodeLights;
class SkySectors;

/// Mean luminance, cd/m², of the surfaces that a place has before it above the horizon, and of all that lies
/// below it: surfaces, and the sky's own ground where there are none.
struct Surroundings {
  Eigen::Array3f above, below;
};

/// At one node of a Transport.
struct NodeLight {
  /// Illuminance, lx: from the sky, and from sun, moon and sky by way of other surfaces. Without the direct
  /// light of sun and moon, nor, at GlintNodes, what of it comes by way of polished floors.
  Eigen::Array3f irradiance;
  Surroundings around;
};

struct Illumination {
  /// Without `nodes`: every surface sees the whole sky that it faces, and no light is bounced.
  Illumination(const sky::Daylight& day_to_use)
      : day(day_to_use) {}  // NOLINT: a Daylight is an open-sky Illumination

  sky::Daylight day;
  /// Of the Transport that made it; null: open sky.
  std::shared_ptr<const NodeLights> nodes;
  /// Share of the sky's light, by cosine, that reaches each node straight if the sky is even, 0 … 1; null as
  /// `nodes`.
  std::shared_ptr<const std::vector<float>> node_open;
  /// Where `nodes` are without what sun and moon throw on walls and ceilings by way of polished floors, since
  /// pictures add it; null: nowhere.
  std::shared_ptr<const GlintNodes> glint_nodes;
  /// Of the sky alone, by what of it is open; null as `nodes`.
  std::shared_ptr<const SkySectors> sky_sectors;
  /// What is seen of the sky in mirrors; null as `nodes`.
  std::shared_ptr<const MirrorSky> mirror_sky;
  /// At each body that moves, for one pose: PreparedPicture sets it; null: open sky.
  std::shared_ptr<const std::vector<AroundLight>> bodies;
  /// That burn, none of them relative: of the world and, where PreparedPicture adds them for its pose, of
  /// bodies; null: none.
  std::shared_ptr<const std::vector<scene::Lamp>> lamps;
  /// That burn, of bodies, in their frames, for PreparedPicture; null: none.
  std::shared_ptr<const std::vector<BodyLamp>> body_lamps;
  /// Of surfaces that shine by themselves those that light straight, as lamps do, since `nodes` are without
  /// it; null: none.
  std::shared_ptr<const std::vector<CompactSource>> compact_sources;
  /// What surfaces pass on of lamps of bodies, for the pose that a renderer looks at, which sets it; null:
  /// nothing.
  std::shared_ptr<const std::vector<BouncedLight>> bounced;
};

struct World;

/// The light of `day` in `world`: relights its transport, if it has one, and lights the lamps that burn then.
Illumination illumination(const World& world, const sky::Daylight& day, const LampOptions& lamps = {});

}  // namespace sunlit::light
