#include "evaluate/run/path_file.h"

#include <filesystem>
#include <set>

#include "evaluate/run/record_files.h"
#include "sunlit/evaluate/same_place.h"
#include "sunlit/image/files.h"

namespace sunlit::evaluate {
namespace {

const char* const kHeader = "pose,stamp,x,y,z,yaw_deg";

std::string lineOf(std::int64_t pose, const PlaceRecord& p) {
  return std::to_string(pose) + "," + formatStamp(p.stamp_ns) + "," + formatNumber(p.x_m) + "," +
         formatNumber(p.y_m) + "," + formatNumber(p.z_m) + "," + formatNumber(p.yaw_deg) + "\n";
}

}  // namespace

PathFile::PathFile(const std::string& folder, const PoseIndex& poses)
    : path_(folder + "/path.csv"), poses_(poses) {
  read(folder);
}

// A run that was killed had no time to take out places of stamps that problems.csv names.
void PathFile::read(const std::string& folder) {
  std::set<std::int64_t> of_two;
  for (const auto& [stamp, pair] : problemsOf(kTwoPlaces, folder)) of_two.insert(stamp);
  forEachCsvRow(folder + "/path.csv", kHeader, [&](const std::vector<std::string>& f) {
    const PlaceRecord place{parseStamp(f[1]), parseNumber(f[2]), parseNumber(f[3]), parseNumber(f[4]),
                            parseNumber(f[5])};
    if (of_two.count(place.stamp_ns) == 0) taken_up_[place.stamp_ns] = place;
  });
  if (taken_up_.empty()) return;
  std::string lines;
  std::int64_t rank = 0;
  for (const auto& [stamp, place] : taken_up_) lines += lineOf(poses_.known(stamp).value_or(rank++), place);
  write(lines);  // without torn ends, before going on
}

// Empty: no image can be of this stamp.
std::optional<std::int64_t> PathFile::keyOf(std::int64_t stamp_ns) const {
  return poses_.hasRate() ? poses_.known(stamp_ns) : stamp_ns;
}

void PathFile::add(const PlaceRecord& place) {
  const std::optional<std::int64_t> key = keyOf(place.stamp_ns);
  if (!key) {
    ++left_out_;
    return;
  }
  const auto found = found_.find(*key);
  const bool is_of_image = found != found_.end();
  PlaceRecord* held = waiting_.find(*key);
  if (is_of_image && found->second) held = &*found->second;
  if (held != nullptr) {
    if (held->stamp_ns != place.stamp_ns) ++left_out_;  // one of the two
    if (!poses_.isNearer(place.stamp_ns, held->stamp_ns)) return;
    *held = place;
  } else if (is_of_image) {
    found->second = place;
  } else if (waiting_.add(*key, place)) {
    ++left_out_;
  }
  if (is_of_image) append(place);
}

void PathFile::noteImage(std::int64_t stamp_ns) {
  const std::optional<std::int64_t> key = keyOf(stamp_ns);
  if (!key) return;
  const auto [found, is_first] = found_.emplace(*key, std::nullopt);
  if (!is_first) return;
  found->second = waiting_.take(*key);
  if (found->second) append(*found->second);
}

void PathFile::append(const PlaceRecord& place) {
  if (!is_open_) file_.open(path_, kHeader);
  is_open_ = true;
  file_.append(lineOf(0, place));  // finish() knows the pose
}

void PathFile::close() {
  file_.close();
  is_open_ = false;
}

// It may hold places that came while images did, and do not count.
void PathFile::remove() {
  close();
  std::filesystem::remove(path_);
}

void PathFile::write(const std::string& lines) {
  close();
  image::writeFileAtomically(path_, std::string(kHeader) + "\n" + lines);
}

LeftOutPlaces PathFile::finish(const std::function<bool(std::int64_t)>& is_of_two_places) {
  std::map<std::int64_t, PlaceRecord> by_pose;
  const auto put = [&](const PlaceRecord& place) {
    const std::optional<std::int64_t> pose = poses_.known(place.stamp_ns);
    if (!pose) return false;
    const auto [held, is_first] = by_pose.emplace(*pose, place);
    // A pose that an earlier run saw under another stamp is the same place.
    if (!is_first && poses_.isNearer(place.stamp_ns, held->second.stamp_ns)) held->second = place;
    return true;
  };
  std::set<std::int64_t> of_two;
  const auto is_of_two = [&](const PlaceRecord& place) {
    if (!is_of_two_places(place.stamp_ns)) return false;
    of_two.insert(place.stamp_ns);
    return true;
  };
  std::map<std::int64_t, PlaceRecord> by_rank;
  std::int64_t rank = 0;
  std::size_t unplaced = 0;
  for (const auto& [stamp, place] : taken_up_) {
    const bool is_lacking = !is_of_two(place) && !put(place);
    if (is_lacking && poses_.wasByOrder(stamp)) ++unplaced;
    if (is_lacking && !poses_.wasByOrder(stamp)) by_rank.emplace(rank, place);
    ++rank;
  }
  for (const auto& item : found_) {
    if (item.second && !is_of_two(*item.second) && !put(*item.second)) ++unplaced;
  }
  by_pose.merge(by_rank);
  std::string lines;
  for (const auto& [pose, place] : by_pose) lines += lineOf(pose, place);
  by_pose.empty() ? remove() : write(lines);
  return {left_out_ + waiting_.size(), unplaced, of_two.size()};
}

}  // namespace sunlit::evaluate
