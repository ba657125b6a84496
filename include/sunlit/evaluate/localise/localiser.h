/// One picture found in a map: retrieval, matching, pose.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sunlit/evaluate/features/detector.h"
#include "sunlit/evaluate/features/features.h"
#include "sunlit/evaluate/features/matching.h"
#include "sunlit/evaluate/localise/map.h"
#include "sunlit/evaluate/localise/pose.h"
#include "sunlit/quantity/field.h"

namespace sunlit::evaluate {

/// Which key frames a query is matched with.
enum class Retrieval {
  kTruth,  ///< the nearest by true position that look the same way, as a robot that knows roughly where it is
  kVlad,   ///< the nearest by what they look like as a whole: VLAD of the detector's features
  kAll     ///< of all, those in which most of the query's strongest features match, one to one
};

/// So many features look into every key frame: enough to tell those that show the same place, and few enough
/// for 1,000 key frames a second.
constexpr std::size_t kScouts = 150;

/// Key frames look the same way where their optical axes are less than this apart.
constexpr double kSameWay_deg = 90.0;

struct LocaliserOptions {
  Retrieval retrieval = Retrieval::kTruth;
  int retrieved = 5;
  /// Lowe's own ratio (IJCV 2004, section 7.1). At the 0.5 that differences are told by, half of what leads
  /// to a pose goes (IMW's accuracy 0.37 against 0.54): RANSAC is there for the wrong ones.
  RatioTest ratio_test{0.8, false};
  PoseOptions pose;
};

std::vector<Field> fieldsOf(LocaliserOptions& options);

enum class LocalisationStatus {
  kLocalised,
  kNoFeatures,     ///< of the query
  kNotRetrieved,   ///< no key frame came into question
  kTooFewMatches,  ///< fewer than min_inliers
  kNoPose          ///< that min_inliers matches support
};

/// "localised", "no_features", "not_retrieved", "too_few_matches", "no_pose".
std::string wordOf(LocalisationStatus status);

/// A picture to be found.
struct LocalisationQuery {
  const Features& features;
  const image::PinholeCamera& camera;
  Eigen::Isometry3d map_from_optical;  ///< the truth
};

struct LocalisedQuery {
  static constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();

  LocalisationStatus status = LocalisationStatus::kNotRetrieved;
  PoseEstimate estimate;      ///< where localised; its inliers are matches, one a feature
  std::size_t matches = 0;    ///< that the pose was sought from
  std::size_t retrieved = 0;  ///< key frames matched
  std::size_t key_frame =
      0;  ///< where localised: the index of that with the most inliers, the first of several
  double error_m = kUndefined;    ///< distance from the truth; NaN where not localised, as the others
  double error_deg = kUndefined;  ///< angle of R_truthᵀ R
  /// As of a relative pose, against one key frame: the larger of error_deg and the angle between the
  /// directions from it to the estimate and to the truth. For equal poses there is no direction, so the key
  /// frame is the nearest to the truth of those at least kLeastBaseline_m away, of equally near ones the
  /// first, within kLengthRounding; NaN without one, too.
  double relative_deg = kUndefined;
  bool has_baseline = false;  ///< there is such a key frame
};

/// Much less, and centimetres decide the direction.
constexpr double kLeastBaseline_m = 1.0;

class PlaceIndex;

/// The map of one detector.
class Localiser {
 public:
  /// `space` is that of the detector's descriptors. Throws std::invalid_argument for options out of range.
  Localiser(const DescriptorSpace& space, const LocaliserOptions& options);
  ~Localiser();

  /// Behind those that are there.
  void add(KeyFrame frame);
  const std::vector<KeyFrame>& frames() const { return frames_; }
  /// Needed once all frames are there: learns what Retrieval::kVlad goes by. Where they have fewer than two
  /// different features, that retrieves nothing.
  void finish();

  /// Of each feature that matches in several key frames the nearest match counts, of equally near ones that
  /// of the key frame retrieved first; within a key frame matches are one to one: accepted from the query,
  /// and the query's feature is the nearest of the key frame's. Runs in parallel, to the same bits; may be
  /// called by several threads at once.
  LocalisedQuery localise(const LocalisationQuery& query) const;

 private:
  struct Matches;
  std::vector<std::size_t> retrieve(const LocalisationQuery& query, const cv::Mat& descriptors) const;
  std::vector<std::size_t> nearestByTruth(const Eigen::Isometry3d& map_from_optical) const;
  std::vector<std::size_t> mostMatched(const LocalisationQuery& query, const cv::Mat& descriptors) const;
  Matches match(const cv::Mat& descriptors, const std::vector<std::size_t>& retrieved) const;
  void judge(const LocalisationQuery& query, LocalisedQuery& result) const;

  DescriptorSpace space_;
  LocaliserOptions options_;
  std::vector<KeyFrame> frames_;
  std::unique_ptr<PlaceIndex> index_;  // where retrieval goes by it
};

}  // namespace sunlit::evaluate
