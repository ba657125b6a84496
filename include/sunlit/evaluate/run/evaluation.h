/// A whole evaluation: images of several streams come in, in any order; result files come out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "sunlit/evaluate/files/frames_file.h"
#include "sunlit/evaluate/localise/localisation_files.h"
#include "sunlit/evaluate/run/counts.h"
#include "sunlit/evaluate/run/evaluation_options.h"
#include "sunlit/evaluate/run/records.h"
#include "sunlit/evaluate/run/told.h"
#include "sunlit/evaluate/stop_token.h"
#include "sunlit/evaluate/verify/verified_file.h"

namespace sunlit::evaluate {

/// What finish() found.
struct Outcome {
  Counts counts;
  std::vector<SummaryRow> summary;
  std::vector<VerifiedSummaryRow> verified;
  std::size_t absent_poses = 0;  ///< of those expected: no image at all came
  std::size_t not_mended = 0;  ///< pairs, or pictures, that earlier or merged runs left out, and this one too
  bool is_broken_off = false;  ///< before all that was whole was compared
  /// Every pair of every pose was evaluated (or is undefined), by this run or those that it takes up, there
  /// was one, and no stream was mostly duplicates.
  bool isWhole() const;
};

/// Called from the threads that add images and from workers. Each of them is called one at a time, but one
/// may be called while another still runs, and `pair_done` and `progress` even after a run was broken off,
/// until the Evaluation is gone. `progress` and `note` must not call it back: they are told under its lock.
/// `progress` is for senders that keep pace: how many poses they may count as done. Of those that an earlier
/// run left it counts none beyond the first expected pose that is not accounted for.
struct EvaluationCallbacks {
  std::function<void(const PairRecord& record, const cv::Mat& a, const cv::Mat& b)> pair_done;
  std::function<void(std::size_t passed_poses)> progress;
  std::function<void(const std::string& line)> note;  ///< something a person should read
};

/// What localising found.
struct LocalisationOutcome {
  bool is_asked = false;                ///< there was something to be done
  std::size_t key_frames = 0;           ///< of the map; without one nothing is written
  std::size_t queries = 0;              ///< looked for, one for each detector
  std::size_t unobserved = 0;           ///< evaluated pictures of queries that lack pose or camera
  std::size_t unmapped = 0;             ///< those of the map that lack depth, pose or camera
  std::vector<std::string> uncompared;  ///< streams of which no picture was evaluated in any pair
  std::vector<std::string> unplaced;    ///< detectors that found features in the map, none placed by depth
  std::vector<LocalisationSummary> summary;  ///< also where it was done before
  bool isWhole() const {
    return !is_asked || (key_frames > 0 && unobserved == 0 && uncompared.empty() && unplaced.empty());
  }
};

/// As what an image came.
struct ImageTraits {
  bool is_lossy = false;  ///< compressed with loss, as JPEG
  bool is_grey = false;   ///< in one channel
};

/// Each is called by one thread at a time.
struct LocaliseCallbacks {
  std::function<void(const LocalisationRow& row)> found;
  std::function<void(std::size_t done, std::size_t all)> progress;
  StopToken stop;  ///< throws Stopped
};

/// Thread-safe. Images are shared, not copied, and must not change afterwards.
///
/// Files in output_dir: frames.csv (grows by one write per pose and pair; sorted at the end), summary.csv,
/// where matches are verified also verified.csv (grows likewise, a pair's rows before those of frames.csv),
/// verified_summary.csv and, of the sampled poses whose images are kept, matches/; run.yaml, problems.csv,
/// captures.csv, path.csv, images/ (a pose's before its rows). A folder that holds an
/// unfinished run with the same settings is taken up again: pairs that it holds are not evaluated twice.
class Evaluation {
 public:
  /// Throws std::invalid_argument for bad options, and where output_dir holds a run with other settings
  /// (naming the first); std::runtime_error for a folder that cannot be written.
  Evaluation(const EvaluationOptions& options, EvaluationCallbacks callbacks);
  ~Evaluation();

  /// An image of options().streams[stream], CV_8UC3, red first. What comes after finish() is left out,
  /// here and below; images are counted. Said once: a stream whose images are compressed with loss, which is
  /// counted too; one that turns grey or coloured; and a pair of a grey and a coloured one.
  void addImage(std::size_t stream, std::int64_t stamp_ns, const cv::Mat& rgb,
                const ImageTraits& traits = {});
  /// An image that could not be decoded, and why.
  void addBadImage(std::size_t stream, std::int64_t stamp_ns, const std::string& fault);
  /// `images` of a stream are missing before that of this stamp, by their sequence numbers.
  void addLost(std::size_t stream, std::size_t images, std::int64_t stamp_ns);
  void addCapture(std::size_t stream, const CaptureRecord& capture);
  /// One that is not finite is named, and left out.
  void addPlace(const PlaceRecord& place);

  /// For what is localised, where options().localisation has a map: depth of a stamp as PosedView has it,
  /// where the camera stood, and a stream's camera: each is that of its stamp; but one alone, as a sender
  /// that latches it sends, is that of all. Of what comes twice the last counts. Stamps wait for them, for a
  /// camera until one of a later stamp has come.
  void addDepth(std::int64_t stamp_ns, const Told<cv::Mat>& depth);
  /// Whatever is localised: pairs of a stamp of which poses of different places come are not evaluated (more
  /// than 1 cm or 0.1° apart), but for those of one stream with itself, and nothing of it is localised.
  void addTruePose(std::int64_t stamp_ns, const Told<Eigen::Isometry3d>& map_from_optical);
  void addCamera(std::size_t stream, std::int64_t stamp_ns, const Told<ViewCamera>& camera);
  /// Names in problems.csv what is wrong with poses from this stamp on, though they are used.
  void addPoseProblem(std::int64_t stamp_ns, const std::string& kind, const std::string& reason);

  const EvaluationOptions& options() const;
  /// Of work for pair_done that takes long: stops it once the run is broken off.
  const StopToken& stopToken() const;
  Counts counts() const;
  /// All expected poses are accounted for; never true where their number is unknown. Rethrows what stopped a
  /// worker, such as a full disk.
  bool isComplete() const;
  /// Blocks until at most `queued_poses` wait for being compared: for sources that can wait. Rethrows as
  /// isComplete().
  void waitForRoom(std::size_t queued_poses) const;
  /// Accounts for everything that still waits, writes all files and stops. Once. What is whole is compared
  /// first, until `broken_off` says so: then it is given up, counted and named, as is what is being compared.
  /// No matter how long a detector still takes, the files are written at once; the destructor waits for it.
  /// This thread asks `broken_off` ten times a second, and under no lock: it may call counts().
  Outcome finish(const StopToken& broken_off = {});
  /// Looks for the queries in the map, after finish(), and writes localisation.csv and
  /// localisation_summary.csv. Nothing where options().localisation has no map, or where they are there
  /// already. A run of a whole path then forgets observations.bin: what was found in every picture.
  LocalisationOutcome localise(const LocaliseCallbacks& callbacks);
  /// Writes comparisons.csv, after finish() and what localise() found. Throws Stopped once `stop` says so,
  /// and then there is no such file.
  void compareMethods(const StopToken& stop = {});

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace sunlit::evaluate
