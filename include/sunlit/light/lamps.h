/// Lamps: when they burn, and what they give where nothing is in the way.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "sunlit/quantity/field.h"
#include "sunlit/scene/scene.h"
#include "sunlit/sky/daylight.h"

namespace sunlit::light {

enum class LampMode {
  kAuto,  ///< by a dusk switch
  kOn,
  kOff,
};

struct LampOptions {
  LampMode mode = LampMode::kAuto;
  double dusk_lx = 30.0;
  std::vector<std::string> off;
  /// White of 1 that gives as much on a plane facing it is a floodlit sports ground under the masts of
  /// Gazebo's worlds, whose attenuation of 0.2 to 1 makes it 50 to 250 lx (EN 12193: 75 to 500 lx).
  double colour_lx = 50.0;
};

inline std::vector<Field> fieldsOf(LampOptions& options) {
  return {{"lamps",
           choiceOf(&options.mode, {"auto", "on", "off"}),
           "",
           {},
           "of the world and the robot; auto: by a dusk switch"},
          {"lamps_dusk",
           &options.dusk_lx,
           "lx",
           {0, 1e5},
           "on level, open ground: auto switches on below it in the evening, off above 1.5 times it at dawn"},
          {"lamps_off", &options.off, "", {}, "groups that stay dark: names of models, links or files"},
          {"lamps_colour",
           &options.colour_lx,
           "lx",
           {0, 1e6},
           "that a light of colour 1 gives where its attenuation is 1, in formats without units (SDF)"}};
}

/// Throws std::invalid_argument naming key, value and range.
void validate(const LampOptions& options);

/// Whether lamps burn under `day`. For `auto` a function of the instant alone, so that no picture depends on
/// those before: street lighting switches off at 1.5 times the light at which it switches on (EN 13201-5
/// calls it the switching ratio), and here the one holds while the sun stands west of the meridian, the other
/// while it stands east of it.
bool burnUnder(const LampOptions& options, const sky::Daylight& day);

/// Those of `lamps` that are not switched off by their group, with intensities that mean cd or lx: none is
/// relative any more.
std::vector<scene::Lamp> burning(const std::vector<scene::Lamp>& lamps, const LampOptions& options);

/// Whether surfaces of `material` show their emission while these lamps burn.
bool glows(const scene::Material& material, const std::vector<scene::Lamp>& burning);

/// `lamp` of a frame that stands at `map_from_frame`, in `map`.
scene::Lamp placed(const scene::Lamp& lamp, const Eigen::Isometry3d& map_from_frame);

/// Light that a part of a surface passes on, as matt surfaces do: by the cosine to `normal`, as from a disc.
struct BouncedLight {
  Eigen::Vector3f position;  ///< its middle, m in `map`
  Eigen::Vector3f normal;    ///< unit
  float radius_m;            ///< of the disc, > 0
  Eigen::Array3f intensity;  ///< along the normal, cd: what leaves it, lm, over π
};

/// A small surface that shines by itself, which is a point but for its shadows: a flat one that shines to one
/// side, or a body that shines to all; or a straight tube.
struct CompactSource {
  Eigen::Vector3f position;  ///< its middle, m in `map`
  Eigen::Array3f intensity;  ///< cd, where it is brightest: of a flat one straight before it
  Eigen::Vector3f normal;    ///< unit, of a flat one; zero: a body, or a tube
  Eigen::Matrix3f shape;  ///< of a body: intensity to the unit vector w is √(wᵀ shape w) of the brightest
  /// Of a flat one: half its length and half its width, at right angles. Of a tube: half its length, and
  /// zero; of a body zero.
  Eigen::Matrix<float, 3, 2> half;
  bool round;      ///< of a flat one: an ellipse of that size, else a rectangle
  float radius_m;  ///< of a disc or ball that is as large to see, > 0
  float reach_m;   ///< how far its surface reaches from `position`
  float uneven_m;  ///< of a flat one: how far its surface is off its plane; of a tube: off its axis
};

/// Groups whose light by way of surfaces is baked apart; what is beyond is baked, and switched, as one.
constexpr std::size_t kMostLampSets = 32;

/// A lamp of the body of that number in World::bodies, in its frame.
struct BodyLamp {
  std::uint32_t body;
  scene::Lamp lamp;
};

}  // namespace sunlit::light
