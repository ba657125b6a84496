/// How far the poses of an estimate are from the truth, as evo 1.x defines it.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sunlit/evaluate/trajectory/alignment.h"

namespace sunlit::evaluate {

/// One value for each pose, or pair of poses.
struct PoseErrors {
  std::vector<double> translation_m;
  std::vector<double> rotation_deg;  ///< 0 … 180
};

/// With Q the pose of the truth and P that of the (aligned) estimate, of each Q⁻¹ P: the length of its
/// translation, and its angle. J. Sturm et al., A benchmark for the evaluation of RGB-D SLAM systems, IROS
/// 2012, eq. 4.
PoseErrors absoluteErrors(const MatchedPoses& poses);

/// How far apart the two poses of a relative error are.
struct Delta {
  enum class Unit { kMetres, kFrames };
  double size = 1.0;  ///< above 0; of frames, a whole number
  Unit unit = Unit::kFrames;

  std::string name() const;  ///< "10m", "0.5m", "1frame"
};

/// Reads name(), and "5frames". Throws std::invalid_argument naming the text and what is allowed.
Delta parseDelta(const std::string& text);

/// Along whose path metres are counted.
enum class PathOf {
  kEstimate,  ///< once aligned: evo's default
  kTruth,     ///< the same pairs for every estimate: evo's --pairs_from_reference
};

struct IndexPair {
  std::size_t first = 0, second = 0;
};

/// Which poses are compared, one pair after another. Frames: 0 and Δ, Δ and 2 Δ, … by index among the matched
/// poses, also across a gap. Metres: each pose at which the path from pose to pose has grown by at least Δ
/// since the one before it, with that one; the first of them is Δ from the start and begins the first pair.
/// Poses 1 m apart but for their last digits may pair at 2 m for a Δ of 1 m, as in evo. Throws
/// std::invalid_argument for a Δ out of its range.
std::vector<IndexPair> pairsApart(const Trajectory& trajectory, const Delta& delta);

/// Of each pair (i, j) of pairsApart(), E = (Qᵢ⁻¹ Qⱼ)⁻¹ (Pᵢ⁻¹ Pⱼ): the length of its translation, and its
/// angle. Sturm et al., eq. 1.
PoseErrors relativeErrors(const MatchedPoses& poses, const Delta& delta, PathOf path);

/// All NaN but n and sse for no errors.
struct ErrorStatistics {
  std::size_t n = 0;
  double rmse, mean, median;
  double std;  ///< divided by n, not n − 1
  double min, max;
  double sse = 0.0;  ///< sum of squares
};

/// The median of an even number is the mean of the middle two.
ErrorStatistics statisticsOfErrors(const std::vector<double>& errors);

}  // namespace sunlit::evaluate
