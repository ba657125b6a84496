#include "evaluate/run/record_files.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "sunlit/evaluate/files/stream_name.h"
#include "sunlit/evaluate/run/one_sun.h"
#include "sunlit/evaluate/same_place.h"
#include "sunlit/image/files.h"

namespace sunlit::evaluate {
namespace {

const char* const kCapturesHeader =
    "stream,pose,stamp,ev100,exposure_mode,sun_azimuth_deg,sun_elevation_deg,"
    "moon_azimuth_deg,moon_elevation_deg,moon_illuminated_fraction,scene_illuminance,utc,utc_s";
constexpr double kFarthest_s = 1e12;  // beyond all years that an Instant is of
const char* const kProblemsHeader = "kind,pose,stamp,where,reason";

std::string lineOf(const std::string& stream, const CaptureRecord& c) {
  return csvField(stream) + "," + std::to_string(c.pose) + "," + formatStamp(c.stamp_ns) + "," +
         formatNumber(c.ev100) + "," + csvField(c.exposure_mode) + "," + formatNumber(c.sun_azimuth_deg) +
         "," + formatNumber(c.sun_elevation_deg) + "," + formatNumber(c.moon_azimuth_deg) + "," +
         formatNumber(c.moon_elevation_deg) + "," + formatNumber(c.moon_illuminated_fraction) + "," +
         formatNumber(c.scene_illuminance_lx) + "," + csvField(c.utc_text) + "," +
         formatNumber(c.utc ? c.utc->secondsSince(Instant()) : std::nan("")) + "\n";
}

CaptureRecord captureOf(const std::vector<std::string>& f) {
  CaptureRecord capture{parsePose(f[1]),   parseStamp(f[2]),  parseNumber(f[3]), f[4],
                        parseNumber(f[5]), parseNumber(f[6]), parseNumber(f[7]), parseNumber(f[8]),
                        parseNumber(f[9]), parseNumber(f[10])};
  capture.utc_text = f[11];
  if (const double utc_s = parseNumber(f[12]); std::abs(utc_s) <= kFarthest_s)
    capture.utc = Instant().plusSeconds(utc_s);
  return capture;
}

std::string lineOf(const Problem& p) {
  return p.kind + "," + (p.pose ? std::to_string(*p.pose) : "") + "," +
         (p.stamp_ns ? formatStamp(*p.stamp_ns) : "") + "," + csvField(p.where) + "," + csvField(p.reason) +
         "\n";
}

/// Of captures.csv; none of another sun, which a run that was killed had no time to leave out, `counts`.
void forEachRow(
    const std::string& folder,
    const std::function<void(const std::string& stream, const CaptureRecord& capture, bool counts)>& use) {
  const auto other_suns = problemsOf(kOtherSun, folder);
  forEachCsvRow(folder + "/captures.csv", kCapturesHeader, [&](const std::vector<std::string>& f) {
    requireStreamName(f[0], "stream");
    const CaptureRecord capture = captureOf(f);
    use(f[0], capture, other_suns.count({capture.stamp_ns, f[0]}) == 0);
  });
}

}  // namespace

void forEachCapture(const std::string& folder,
                    const std::function<void(const std::string&, const CaptureRecord&)>& use) {
  forEachRow(folder, [&](const std::string& stream, const CaptureRecord& capture, bool counts) {
    if (counts) use(stream, capture);
  });
}

RecordFiles::RecordFiles(const std::string& folder, PoseIndex& poses)
    : folder_(folder), path_(folder, poses) {
  read(folder, poses);
}

void RecordFiles::merge(const std::string& other_folder, PoseIndex& poses) {
  read(other_folder, poses);
  path_.merge(other_folder);
}

void RecordFiles::read(const std::string& folder, PoseIndex& poses) {
  bool has_any = false;
  forEachRow(folder, [&](const std::string& stream, const CaptureRecord& capture, bool counts) {
    has_any = true;
    if (counts) keep(stream, capture);
    poses.learn(capture.stamp_ns, capture.pose);
  });
  if (has_any) writeCaptures({});  // without torn ends, before going on
}

bool RecordFiles::add(const std::string& stream, const CaptureRecord& capture, bool is_held) {
  if (!come_.emplace(stream, capture.stamp_ns).second) return false;
  if (const auto held = captures_.find({stream, capture.pose}); held != captures_.end()) {
    if (is_held) return true;
    if (come_.count({stream, held->second.stamp_ns}) == 0) captures_.erase(held);
  }
  openCaptures();
  keep(stream, capture);
  captures_file_.append(lineOf(stream, capture));
  noteImage(capture.stamp_ns);  // even if it never comes
  return true;
}

void RecordFiles::keep(const std::string& stream, const CaptureRecord& capture) {
  const auto [held, is_first] = captures_.emplace(std::make_pair(stream, capture.pose), capture);
  if (!is_first && capture.stamp_ns <= held->second.stamp_ns) held->second = capture;
}

void RecordFiles::writeCaptures(const std::vector<std::string>& streams) {
  captures_file_.close();
  is_open_ = false;
  const auto rank = [&](const std::string& stream) {
    return std::find(streams.begin(), streams.end(), stream) - streams.begin();
  };
  std::vector<std::pair<std::string, CaptureRecord>> sorted;
  for (const auto& item : captures_) sorted.emplace_back(item.first.first, item.second);
  std::stable_sort(sorted.begin(), sorted.end(), [&](const auto& l, const auto& r) {
    return std::make_pair(rank(l.first), l.second.pose) < std::make_pair(rank(r.first), r.second.pose);
  });
  std::string text = std::string(kCapturesHeader) + "\n";
  for (const auto& item : sorted) text += lineOf(item.first, item.second);
  image::writeFileAtomically(folder_ + "/captures.csv", text);
  openCaptures();
}

void RecordFiles::openCaptures() {
  if (!is_open_) captures_file_.open(folder_ + "/captures.csv", kCapturesHeader);
  is_open_ = true;
}

LeftOutPlaces RecordFiles::finish(const std::vector<std::string>& streams, const IsLeftOut& is_left_out,
                                  const std::function<bool(std::int64_t)>& is_of_two_places) {
  const bool has_any = !captures_.empty();
  for (auto item = captures_.begin(); item != captures_.end();)
    item = is_left_out(item->first.first, item->second) ? captures_.erase(item) : std::next(item);
  if (has_any) writeCaptures(streams);
  return path_.finish(is_of_two_places);
}

std::set<std::pair<std::int64_t, std::string>> problemsOf(const std::string& kind,
                                                          const std::string& folder) {
  std::set<std::pair<std::int64_t, std::string>> named;
  forEachCsvRow(folder + "/problems.csv", kProblemsHeader, [&](const std::vector<std::string>& f) {
    if (f[0] == kind && !f[2].empty()) named.emplace(parseStamp(f[2]), f[3]);
  });
  return named;
}

std::map<std::int64_t, std::int64_t> posesOfProblems(const std::string& folder) {
  std::map<std::int64_t, std::int64_t> poses;
  forEachCsvRow(folder + "/problems.csv", kProblemsHeader, [&](const std::vector<std::string>& f) {
    if (f[0] != kUnexpected && f[0] != kUnusable && !f[1].empty() && !f[2].empty())
      poses.emplace(parseStamp(f[2]), parsePose(f[1]));
  });
  return poses;
}

ProblemFile::ProblemFile(const std::string& folder, const std::vector<std::string>& merged)
    : path_(folder + "/problems.csv") {
  read(path_);
  for (const std::string& other : merged) read(other + "/problems.csv");
  image::writeFileAtomically(path_, text());  // without a torn end, before going on
  file_.open(path_, kProblemsHeader);
}

void ProblemFile::read(const std::string& path) {
  forEachCsvRow(path, kProblemsHeader, [&](const std::vector<std::string>& f) {
    Problem problem{f[0], std::nullopt, std::nullopt, f[3], f[4]};
    if (!f[1].empty()) problem.pose = parsePose(f[1]);
    if (!f[2].empty()) problem.stamp_ns = parseStamp(f[2]);
    if (problem.kind == kOtherSun || problem.kind == kTwoPlaces) {
      problem.reason = problem.kind + ": " + problem.reason;
      problem.kind = kLeftOutBefore;
    }
    if (known_.insert(keyOf(problem)).second) problems_.push_back(problem);
  });
}

// Where there is a stamp, it tells problems apart: the pose may have become known, or settled, meanwhile.
std::string ProblemFile::keyOf(const Problem& problem) {
  const std::string place =
      problem.stamp_ns ? formatStamp(*problem.stamp_ns) : "pose " + std::to_string(problem.pose.value_or(-1));
  return problem.kind + "," + place + "," + csvField(problem.where) + "," + csvField(problem.reason);
}

void ProblemFile::add(const Problem& problem) {
  const std::string key = keyOf(problem);
  met_now_.insert(key);
  if (!known_.insert(key).second) return;
  problems_.push_back(problem);
  file_.append(lineOf(problem));
}

std::string ProblemFile::text() const {
  std::string text = std::string(kProblemsHeader) + "\n";
  for (const Problem& problem : problems_) text += lineOf(problem);
  return text;
}

std::vector<Problem> ProblemFile::finish(const PoseIndex& poses,
                                         const std::function<bool(const Problem&)>& is_mended) {
  file_.close();
  for (Problem& problem : problems_) {
    if (problem.pose && problem.stamp_ns) problem.pose = poses.settled(*problem.stamp_ns, *problem.pose);
  }
  const auto isMet = [&](const Problem& p) { return met_now_.count(keyOf(p)) != 0; };
  const auto placeOf = [](const Problem& p) { return std::make_pair(p.stamp_ns, p.where); };
  std::set<std::pair<std::optional<std::int64_t>, std::string>> met_places;
  for (const Problem& problem : problems_)
    if (isMet(problem)) met_places.insert(placeOf(problem));
  const auto isOver = [&](const Problem& p) {
    const bool is_named_anew = p.kind == kLeftOutBefore && met_places.count(placeOf(p)) != 0;
    return !isMet(p) && (is_named_anew || is_mended(p));
  };
  problems_.erase(std::remove_if(problems_.begin(), problems_.end(), isOver), problems_.end());
  std::vector<Problem> old;
  std::remove_copy_if(problems_.begin(), problems_.end(), std::back_inserter(old), isMet);
  const auto key = [](const Problem& p) { return std::tie(p.stamp_ns, p.kind, p.where, p.reason, p.pose); };
  std::stable_sort(problems_.begin(), problems_.end(),
                   [&](const Problem& l, const Problem& r) { return key(l) < key(r); });
  image::writeFileAtomically(path_, text());
  return old;
}

}  // namespace sunlit::evaluate
