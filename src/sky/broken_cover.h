/// The sky below broken cloud, and where the cloud's shadows lie.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "cloud_map.h"
#include "droplets.h"
#include "layer_sky.h"

namespace sunlit::sky {

/// How a cloud layer lies over `map`.
struct CloudPlace {
  std::shared_ptr<const CloudMap> map;
  double base_m;            ///< above the ground's level
  Eigen::Vector2d drift_m;  ///< how far it has moved
};

/// Each place of the cloud shines as an even layer of its optical depth would. So there is no light that
/// enters by a cloud's sides, and none is lost there; and clouds are flat. The light that ground and cloud
/// pass on to each other is that of their means.
class BrokenCover {
 public:
  /// Where `above` falls on it.
  BrokenCover(const CloudPlace& place, const LightAbove& above, const Droplets& droplets, float albedo_below);

  /// What is seen of the cloud from a place: x and y in `map`, z above the ground's level.
  struct Seen {
    Eigen::Array3f scattered;  ///< cd/m²
    float passed;              ///< of what is behind, straight
    float distance_m;
  };
  Seen seen(const Eigen::Vector3f& towards, const Eigen::Vector3f& from) const;
  /// What of light from straight `towards` comes through to a place: of a disc of the width of sun and moon
  /// that is one of those above, or else through a thin line. From below the horizon as from it: the rim of a
  /// disc still shines whose middle has set.
  float passed(const Eigen::Vector3f& towards, const Eigen::Vector3f& from) const;
  /// The mean of that over all places.
  float meanPassed(float z) const;
  /// Illuminance of level ground, the mean over all places, lx.
  const Eigen::Array3f& level() const { return level_; }

 private:
  struct Way {
    Eigen::Vector2d place_m;
    float cosine;  ///< of the angle to the vertical, at the cloud
    float distance_m;
  };
  /// What comes through from a disc at an elevation of sine `z`, which every surface asks for.
  struct Shadows {
    float z, mean;
    CellMeans passed;
  };
  Way wayUp(const Eigen::Vector3f& towards, const Eigen::Vector3f& from) const;

  CloudPlace place_;
  std::vector<LayerSky> skies_;   // by optical depth
  std::vector<Shadows> shadows_;  // of sun and moon
  Eigen::Array3f level_ = Eigen::Array3f::Zero();
};

}  // namespace sunlit::sky
