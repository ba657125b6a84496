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
#include "sunlit/evaluate/run/evaluation_options.h"
#include "sunlit/evaluate/run/told.h"
#include "sunlit/evaluate/stop_token.h"
#include "sunlit/evaluate/verify/verified_file.h"

namespace sunlit::evaluate {

/// How an image was taken.
struct CaptureRecord {
  std::int64_t pose = 0;
  std::int64_t stamp_ns = 0;
  double ev100 = 0.0;
  std::string exposure_mode;               ///< how that was chosen: "fixed" or "auto"
  double sun_azimuth_deg = 0.0;            ///< clockwise from north
  double sun_elevation_deg = 0.0;          ///< apparent
  double moon_azimuth_deg = 0.0;           ///< clockwise from north; NaN, as the next two, without a night
  double moon_elevation_deg = 0.0;         ///< apparent
  double moon_illuminated_fraction = 0.0;  ///< 0 new … 1 full
  double scene_illuminance_lx = 0.0;
};

/// Where the camera stood, in `map`.
struct PlaceRecord {
  std::int64_t stamp_ns = 0;
  double x_m = 0.0, y_m = 0.0, z_m = 0.0;
  double yaw_deg = 0.0;  ///< of the camera's x axis, counter-clockwise from east
};

struct StreamCounts {
  std::size_t received = 0;
  std::size_t duplicate = 0;     ///< stamp had come before
  std::size_t out_of_order = 0;  ///< used all the same
  std::size_t undecodable = 0;
  std::size_t late = 0;     ///< came after its stamp had been given up
  std::size_t dropped = 0;  ///< given up to bound the memory, or since the run was broken off
  std::size_t lost = 0;  ///< or left out by a throttle, as far as told by addLost(); not among the received
  std::size_t unexpected = 0;   ///< of a pose that is not one of those expected
  std::size_t lossy = 0;        ///< compressed with loss
  std::size_t no_features = 0;  ///< a detector found nothing in it; once for each that did not
  std::size_t unlocalised = 0;  ///< could be neither key frame nor query, or not for all detectors
  std::optional<std::int64_t> only_stamp_ns;  ///< that all of them have, where they have one alone
  /// Most were left out, as those of a driver that sets no stamps are: what was evaluated is not what was
  /// sent.
  bool isMostlyDuplicate() const { return duplicate > received - duplicate; }
};

/// evaluated + resumed + the others = pairs asked for.
struct PairCounts {
  std::size_t evaluated = 0;        ///< in this run; undefined values included
  std::size_t resumed = 0;          ///< taken over from an earlier run
  std::size_t missing_partner = 0;  ///< one image never came, or both
  std::size_t undecodable = 0;
  std::size_t size_mismatch = 0;
  std::size_t dropped = 0;     ///< given up to bound the memory, or since the run was broken off
  std::size_t failed = 0;      ///< the comparison itself failed
  std::size_t unplaced = 0;    ///< no capture said which pose it is, or the stamp lies before the first
  std::size_t duplicate = 0;   ///< an earlier stamp is of the same pose; that one counts
  std::size_t two_places = 0;  ///< poses of its stamp differ: its images may be of two recordings
  std::size_t notEvaluated() const {
    return missing_partner + undecodable + size_mismatch + dropped + failed + unplaced + duplicate +
           two_places;
  }
};

struct Counts {
  std::vector<StreamCounts> streams;  ///< in the order of the options
  std::vector<PairCounts> pairs;
  std::size_t completed_poses = 0;           ///< all their pairs are accounted for; unexpected ones included
  std::size_t unexpected_poses = 0;          ///< of them: not among those expected
  std::size_t waiting_images = 0;            ///< for a partner
  std::size_t queued_poses = 0;              ///< whole, but not compared yet
  std::size_t after_end = 0;                 ///< images that came after finish(), and were left out
  std::size_t bytes = 0;                     ///< of what waits, as the memory limit counts them
  std::vector<std::size_t> awaited_streams;  ///< that the oldest waiting stamp lacks
  bool awaits_truth = false;  ///< it has all streams, but lacks the pose, depth or camera to localise by
};

/// What finish() found.
struct Outcome {
  Counts counts;
  std::vector<SummaryRow> summary;
  std::vector<VerifiedSummaryRow> verified;
  std::size_t absent_poses = 0;  ///< of those expected: no image at all came
  bool is_broken_off = false;    ///< before all that was whole was compared
  /// Every pair of every pose was evaluated (or is undefined), there was one, and no stream was mostly
  /// duplicates.
  bool isWhole() const;
};

/// Called from the threads that add images and from workers. Each of them is called one at a time, but one
/// may be called while another still runs, and `pair_done` and `progress` even after a run was broken off,
/// until the Evaluation is gone. `progress` and `note` must not call it back: they are told under its lock.
struct EvaluationCallbacks {
  std::function<void(const PairRecord& record, const cv::Mat& a, const cv::Mat& b)> pair_done;
  std::function<void(std::size_t completed_poses)> progress;
  std::function<void(const std::string& line)> note;  ///< something a person should read
};

/// What localising found.
struct LocalisationOutcome {
  bool is_asked = false;                ///< there was something to be done
  std::size_t key_frames = 0;           ///< of the map; without one nothing is written
  std::size_t queries = 0;              ///< looked for, one for each detector
  std::size_t unobserved = 0;           ///< evaluated pictures that lack depth, pose or camera
  std::vector<std::string> uncompared;  ///< streams of which no picture was evaluated in any pair
  std::vector<std::string> unplaced;    ///< detectors that found features in the map, none placed by depth
  std::vector<LocalisationSummary> summary;  ///< also where it was done before
  bool isWhole() const {
    return !is_asked || (key_frames > 0 && unobserved == 0 && uncompared.empty() && unplaced.empty());
  }
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
  /// here and below; images are counted.
  void addImage(std::size_t stream, std::int64_t stamp_ns, const cv::Mat& rgb);
  /// The same of one that was compressed with loss, as JPEG: said once for each stream, and counted.
  void addLossyImage(std::size_t stream, std::int64_t stamp_ns, const cv::Mat& rgb);
  /// An image that could not be decoded, and why.
  void addBadImage(std::size_t stream, std::int64_t stamp_ns, const std::string& fault);
  /// `images` of a stream are missing before that of this stamp, by their sequence numbers.
  void addLost(std::size_t stream, std::size_t images, std::int64_t stamp_ns);
  void addCapture(std::size_t stream, const CaptureRecord& capture);
  /// One that is not finite is named, and left out.
  void addPlace(const PlaceRecord& place);

  /// For what is localised, where options().localisation has a map: depth of a stamp as PosedView has it,
  /// where the camera stood, and a stream's camera. Of what comes twice the last counts. Stamps wait for
  /// them.
  void addDepth(std::int64_t stamp_ns, const Told<cv::Mat>& depth);
  /// Whatever is localised: pairs of a stamp of which poses of different places come are not evaluated (more
  /// than 1 cm or 0.1° apart), but for those of one stream with itself, and nothing of it is localised.
  void addTruePose(std::int64_t stamp_ns, const Told<Eigen::Isometry3d>& map_from_optical);
  void addCamera(std::size_t stream, const Told<ViewCamera>& camera);
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
