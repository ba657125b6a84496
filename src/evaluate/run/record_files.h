/// captures.csv, path.csv and problems.csv: what is known of the images beside their differences.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "evaluate/files/files.h"
#include "evaluate/run/path_file.h"
#include "evaluate/run/pose_index.h"
#include "sunlit/evaluate/run/evaluation.h"

namespace sunlit::evaluate {

/// What captures.csv of `folder` has that counts, by stream and in no order.
void forEachCapture(const std::string& folder,
                    const std::function<void(const std::string& stream, const CaptureRecord& capture)>& use);

/// captures.csv and path.csv. They grow while images come in and are sorted, without doubles, at the end.
class RecordFiles {
 public:
  /// Reads what an earlier run left in `folder`, tells `poses`, which outlives this, and goes on from there.
  RecordFiles(const std::string& folder, PoseIndex& poses);
  /// Adds what a run in another folder left.
  void merge(const std::string& other_folder, PoseIndex& poses);
  /// Of those of one stream and stamp the first counts that comes, as of images; one of an earlier run only
  /// where this `is_held`: its picture is not evaluated again. Whether it is the first.
  bool add(const std::string& stream, const CaptureRecord& capture, bool is_held);
  /// By stream, and then by pose.
  const std::map<std::pair<std::string, std::int64_t>, CaptureRecord>& captures() const { return captures_; }
  void add(const PlaceRecord& place) { path_.add(place); }
  /// An image of this stamp came.
  void noteImage(std::int64_t stamp_ns) { path_.noteImage(stamp_ns); }
  using IsLeftOut = std::function<bool(const std::string& stream, const CaptureRecord& capture)>;
  /// As PathFile::finish(), and without captures that are left out.
  LeftOutPlaces finish(const std::vector<std::string>& streams, const IsLeftOut& is_left_out,
                       const std::function<bool(std::int64_t)>& is_of_two_places);

 private:
  void read(const std::string& folder, PoseIndex& poses);
  void keep(const std::string& stream, const CaptureRecord& capture);
  void writeCaptures(const std::vector<std::string>& streams);
  void openCaptures();
  std::string folder_;
  AppendFile captures_file_;
  bool is_open_ = false;
  std::map<std::pair<std::string, std::int64_t>, CaptureRecord>
      captures_;  // by stream and pose: of the earliest stamp, as frames.csv
  std::set<std::pair<std::string, std::int64_t>> come_;  // streams and stamps, in this run
  PathFile path_;
};

/// How many lines of an earlier run are not taken up.
struct LeftLines {
  std::size_t torn = 0, asked_again = 0;

  LeftLines& operator+=(const LeftLines& other) {
    torn += other.torn;
    asked_again += other.asked_again;
    return *this;
  }
};

/// One thing that did not go as it should.
struct Problem {
  std::string kind;                  ///< missing_partner, undecodable, …: a column name of the counters
  std::optional<std::int64_t> pose;  ///< where it is known
  std::optional<std::int64_t> stamp_ns;
  std::string where;  ///< a stream, or a pair as "a-b"
  std::string reason;
};

/// Problem::kind of an image of a pose that is none of those expected.
inline constexpr const char* kUnexpected = "unexpected";
/// Of a capture or a place, whose stamp may be that of no image.
inline constexpr const char* kUnusable = "unusable";
/// Of what an earlier run left out, as of other suns or two places, or had no time to: it is asked for again.
inline constexpr const char* kLeftOutBefore = "left_out_before";

/// Problem::reason of a stamp without a pose, and of the later one of two of one pose.
inline constexpr const char* kNoCapture = "no capture of this stamp says which pose it is";
inline constexpr const char* kEarlierCounts = "an earlier stamp is of this pose too, and counts";

/// Poses by the stamps of images that problems.csv of `folder` names, but of unexpected ones.
std::map<std::int64_t, std::int64_t> posesOfProblems(const std::string& folder);

/// Stamps and places, a stream or a pair, of problems of one kind, by problems.csv of `folder`.
std::set<std::pair<std::int64_t, std::string>> problemsOf(const std::string& kind, const std::string& folder);

/// problems.csv of this run and of those that it takes up. Each problem stands there once, however often it
/// was met.
class ProblemFile {
 public:
  /// Begins with what `folder` and those that are merged have; what they left out becomes kLeftOutBefore.
  ProblemFile(const std::string& folder, const std::vector<std::string>& merged);
  void add(const Problem& problem);
  /// Sorted by stamp, kind and place; each pose as `poses` has settled it; without those of earlier runs that
  /// this one did not meet and of which `is_mended` says that it mended them. Returns those that stay.
  std::vector<Problem> finish(const PoseIndex& poses, const std::function<bool(const Problem&)>& is_mended);

 private:
  static std::string keyOf(const Problem& problem);
  void read(const std::string& path);
  std::string text() const;
  std::string path_;
  AppendFile file_;
  std::vector<Problem> problems_;
  std::set<std::string> known_;    // by keyOf()
  std::set<std::string> met_now_;  // those of this run
};

}  // namespace sunlit::evaluate
