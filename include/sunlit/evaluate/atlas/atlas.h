/// A path seen under many lights: what a map made under one is worth under each other, method by method. What
/// was found in the pictures is kept on disk; maps and queries are made of that.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "sunlit/evaluate/localise/drive_index.h"
#include "sunlit/evaluate/localise/localiser.h"
#include "sunlit/evaluate/verify/verify.h"
#include "sunlit/image/camera.h"
#include "sunlit/image/images.h"

namespace sunlit::evaluate {

/// A method is a detector with its parameters, as those of `verify`; their ratio test tells D and precision,
/// that of the localiser which matches lead to a pose.
struct AtlasOptions {
  VerifyOptions verify;
  double map_every_m = 5.0;
  LocaliserOptions localiser;
  bool has_query_drive = false;  ///< queries are of a drive of their own, beside that of the maps
};

/// What the condition of a picture is called that the query drive took, where there is one.
std::string queryDriveOf(const std::string& condition);

/// What a camera sees from one pose of the path, under one light or several.
struct AtlasView {
  struct Lit {
    std::string condition;
    image::Rgb8Image picture;
    double ev100 = 0.0;
  };
  std::int64_t pose = 0;
  image::PinholeCamera camera;
  Eigen::Isometry3d map_from_optical = Eigen::Isometry3d::Identity();
  image::DepthImage depth;
  std::vector<Lit> lit;
};

/// Finds features by all methods, and keeps them.
class AtlasObserver {
 public:
  /// Throws std::invalid_argument for an option out of range.
  explicit AtlasObserver(const AtlasOptions& options);
  ~AtlasObserver();

  /// Adds to `file` what it lacks of `view`: by picture and then by method, in the order of both, so that
  /// what a file holds after a broken off run, taken up again, is the same to the byte. In parallel. Throws
  /// as detectors and the file do.
  void observe(AtlasView view, ObservationFile* file) const;

 private:
  struct Method;
  std::vector<std::unique_ptr<Method>> methods_;
};

/// By condition and pose: pictures of which `file` holds the features of all `methods`.
std::set<std::pair<std::string, std::int64_t>> observedWhole(const ObservationFile& file,
                                                             std::size_t methods);

/// One query, found in the map or not. And what features are worth between two pictures of its pose from the
/// drive of the maps, one in the map's light and one in the query's.
struct AtlasRow {
  static constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();

  std::int64_t pose = 0;
  LocalisationStatus status = LocalisationStatus::kNotRetrieved;
  double error_m = kUndefined;  ///< as LocalisedQuery, so the next ones
  double error_deg = kUndefined;
  std::size_t inliers = 0;
  double difference = kUndefined;      ///< the paper's D, as DifferenceValue::value
  double matching_score = kUndefined;  ///< as Verified, so the next one
  double precision = kUndefined;
  double ev100 = kUndefined;  ///< of the query's picture
};

/// Which cell of the atlas.
struct AtlasCellKey {
  std::string map;  ///< conditions
  std::string query;
  std::string method;
};

/// The map of one condition and method.
class AtlasMap {
 public:
  /// Reads the key frames. The index outlives this. Throws std::invalid_argument for a method that there is
  /// not and std::runtime_error where the drive has not been observed.
  AtlasMap(const DriveIndex& observed, const AtlasOptions& options, const AtlasCellKey& of_map_and_method);

  /// In memory, on average.
  double bytesOfKeyFrame() const;
  /// All poses of the drive under `query`, in their order. Truth of the comparison is the identity: both see
  /// from the same pose. Without a query drive a query whose pose is that of a key frame is looked for in a
  /// map that holds its own place. In parallel, to the same bits. Throws std::runtime_error where a pose
  /// lacks a partner.
  std::vector<AtlasRow> find(const std::string& query) const;

 private:
  const ObservedDrive& driveOf(const std::string& condition) const;
  AtlasRow rowOf(std::int64_t pose, const std::string& query) const;
  void compare(std::int64_t pose, const Observation& lit_as_query, AtlasRow* row) const;

  const DriveIndex& observed_;
  AtlasOptions options_;
  AtlasCellKey key_;
  DescriptorSpace space_;
  const ObservedDrive& drive_;
  std::unique_ptr<Localiser> map_;
};

}  // namespace sunlit::evaluate
