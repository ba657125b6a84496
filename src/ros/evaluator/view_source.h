/// Images of bags with all that is known of them, a few at a time; and what cannot be used, which is counted
/// and named.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "ros/evaluator/bag_views.h"
#include "ros/evaluator/folder_lock.h"
#include "ros/evaluator/pose_frames.h"
#include "ros/evaluator/view_topics.h"
#include "sunlit/evaluate/localise/localisation.h"
#include "sunlit/evaluate/localise/localisation_files.h"
#include "sunlit/evaluate/trajectory/trajectory.h"

namespace sunlit::ros_interface {

/// What is read of bags, and where it is told of.
struct ViewSourceOptions {
  ViewTopics topics;
  IntakeOptions intake;
  std::string output_dir;           ///< of localisation_problems.csv and all other results
  bool has_frame_a_stream = false;  ///< poses of several streams are not compared
};

class ViewSource {
 public:
  /// Holds output_dir for as long as it lives; throws as FolderLock does.
  explicit ViewSource(const ViewSourceOptions& options) : options_(options), lock_(options.output_dir) {}

  /// Says what is read.
  std::unique_ptr<BagViews> open(const BagStream& stream) const;
  /// Entries that have a camera and a pose and, where it `needs_depth`, depth. The others are problems, and
  /// poses of another frame than those before are warned of.
  std::vector<std::size_t> usable(const BagViews& views, bool needs_depth);
  /// Hands on the views of `entries`, with the entries that they are of, a few at a time; those that cannot
  /// be read are problems, as is what detectors threw. `work` as in "queries localised". Throws
  /// std::runtime_error where output_dir was taken away meanwhile.
  struct Job {
    std::string work;
    bool needs_depth = false;
    std::function<evaluate::DetectorFaults(const std::vector<std::size_t>& entries,
                                           const std::vector<evaluate::PosedView>& views)>
        hand;
  };
  void forEach(const BagViews& views, const std::vector<std::size_t>& entries, const Job& job);

  /// A detector finds nothing in an image, or in one of the map nothing whose place its depth tells. It is
  /// used all the same.
  void addFeatureless(const BagStream& stream, bool is_of_map, std::int64_t stamp_ns,
                      const std::string& detector);

  /// Writes localisation_problems.csv and throws std::runtime_error of `what`, with the problems in words.
  [[noreturn]] void fail(const std::string& what) const;
  /// Writes localisation_problems.csv and says what there is. The exit status of the program.
  int finish() const;

 private:
  std::vector<evaluate::LocalisationProblem> unusable() const;
  /// Counts images that cannot be used and names the first.
  std::string problemsInWords() const;
  void writeProblems() const;
  void noteFrames(const BagViews& views, bool is_of_map);
  void addProblem(const BagStream& stream, bool needs_depth, std::int64_t stamp_ns, const std::string& fault);

  ViewSourceOptions options_;
  FolderLock lock_;
  std::vector<evaluate::LocalisationProblem> problems_;
  std::size_t featureless_ = 0;  // of problems
  PoseFrames frames_;
};

/// Of camera_link.
evaluate::StampedPose poseOfLink(std::int64_t stamp_ns, const Eigen::Isometry3d& map_from_optical);

}  // namespace sunlit::ros_interface
