#include "evaluate/files/picture_writer.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <vector>

#include "sunlit/image/codecs.h"
#include "sunlit/image/files.h"

namespace sunlit::evaluate {
namespace {

// OpenCV does not notice where the last of a file finds no room on the disk, so it only encodes.
std::string pngOf(const std::string& path, const cv::Mat& rgb) {
  cv::Mat bgr;
  cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
  const std::vector<std::uint8_t> bytes = image::encodePicture(".png", bgr);
  if (bytes.empty()) throw std::runtime_error(path + ": OpenCV cannot encode this picture");
  return {bytes.begin(), bytes.end()};
}

}  // namespace

std::string PictureWriter::pathOf(const std::string& stream, std::int64_t pose) const {
  char name[40];
  std::snprintf(name, sizeof name, "%06lld.png", static_cast<long long>(pose));
  return folder_ + "/" + stream + "/" + name;
}

std::string PictureWriter::pathOf(const std::string& stream, const Aside& aside) const {
  return aside.pose ? pathOf(stream, *aside.pose) : pathOf(stream, aside.number) + ".aside";
}

bool PictureWriter::claim(const std::string& stream, std::int64_t pose, std::int64_t stamp_ns,
                          bool is_evaluated) {
  const std::lock_guard<std::mutex> lock(stamps_mutex_);
  const bool is_first = stamps_.emplace(std::make_pair(stream, pose), stamp_ns).second;
  if (!is_evaluated) return is_first && !std::filesystem::exists(pathOf(stream, pose));
  stamps_[{stream, pose}] = stamp_ns;
  return true;
}

bool PictureWriter::isClaimedBy(const std::string& stream, std::int64_t pose, std::int64_t stamp_ns) {
  const std::lock_guard<std::mutex> lock(stamps_mutex_);
  const auto found = stamps_.find({stream, pose});
  return found != stamps_.end() && found->second == stamp_ns;
}

void PictureWriter::write(const std::string& stream, std::int64_t pose, std::int64_t stamp_ns,
                          const cv::Mat& rgb) {
  const std::string png = pngOf(pathOf(stream, pose), rgb);
  // One file at a time, so that the last claim is written last.
  const std::lock_guard<std::mutex> one_at_a_time(files_mutex_);
  const auto aside = aside_.find({stamp_ns, stream});
  const bool is_aside = aside != aside_.end() && !aside->second.pose;
  const std::int64_t known_pose = aside == aside_.end() ? pose : aside->second.pose.value_or(pose);
  if (!is_aside && !isClaimedBy(stream, known_pose, stamp_ns)) return;
  const std::string path = is_aside ? pathOf(stream, aside->second) : pathOf(stream, known_pose);
  image::makeFolder(std::filesystem::path(path).parent_path().string());
  image::writeFileAtomically(path, png);
}

void PictureWriter::remove(const std::string& stream, std::int64_t pose) {
  const std::lock_guard<std::mutex> one_at_a_time(files_mutex_);
  const std::lock_guard<std::mutex> lock(stamps_mutex_);
  stamps_.erase({stream, pose});
  std::filesystem::remove(pathOf(stream, pose));
}

void PictureWriter::removeOf(const std::string& stream, std::int64_t pose, std::int64_t stamp_ns) {
  if (isClaimedBy(stream, pose, stamp_ns)) remove(stream, pose);
}

std::vector<std::int64_t> PictureWriter::posesOf(const std::string& stream) const {
  std::vector<std::int64_t> poses;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(folder_ + "/" + stream, none)) {
    const std::string name = entry.path().stem().string();
    const bool is_number = !name.empty() && name.find_first_not_of("0123456789") == std::string::npos;
    if (is_number && entry.path().extension() == ".png") poses.push_back(std::stoll(name));
  }
  std::sort(poses.begin(), poses.end());
  return poses;
}

void PictureWriter::setAside() {
  const std::lock_guard<std::mutex> one_at_a_time(files_mutex_);
  const std::lock_guard<std::mutex> lock(stamps_mutex_);
  for (const auto& [place, stamp] : stamps_) {
    const auto& [stream, number] = place;
    const Aside aside{number, std::nullopt};
    aside_[{stamp, stream}] = aside;
    const std::string path = pathOf(stream, number);
    if (std::filesystem::exists(path)) std::filesystem::rename(path, pathOf(stream, aside));
  }
  stamps_.clear();
}

void PictureWriter::give(std::int64_t stamp_ns, std::int64_t pose) {
  const std::lock_guard<std::mutex> one_at_a_time(files_mutex_);
  const std::lock_guard<std::mutex> lock(stamps_mutex_);
  for (auto item = aside_.lower_bound({stamp_ns, ""}); item != aside_.end(); ++item) {
    auto& [place, aside] = *item;
    const auto& [stamp, stream] = place;
    if (stamp != stamp_ns) return;
    if (aside.pose) continue;
    const std::string path = pathOf(stream, aside);
    aside.pose = pose;
    std::int64_t& claim = stamps_.emplace(std::make_pair(stream, pose), stamp).first->second;
    claim = std::min(claim, stamp);
    if (!std::filesystem::exists(path)) continue;
    if (claim == stamp) {
      std::filesystem::rename(path, pathOf(stream, pose));
    } else {
      std::filesystem::remove(path);
    }
  }
}

void PictureWriter::finish(const std::function<std::int64_t(std::int64_t, std::int64_t)>& settled_pose) {
  const std::lock_guard<std::mutex> one_at_a_time(files_mutex_);
  const std::lock_guard<std::mutex> lock(stamps_mutex_);
  for (const auto& [place, aside] : aside_)
    if (!aside.pose) std::filesystem::remove(pathOf(place.second, aside));
  // By way of other names, since numbers may change places.
  std::vector<std::pair<std::string, std::string>> moves;
  for (const auto& item : stamps_) {
    const std::int64_t pose = item.first.second;
    const std::int64_t settled = settled_pose(item.second, pose);
    const std::string path = pathOf(item.first.first, pose);
    if (settled == pose || !std::filesystem::exists(path)) continue;
    moves.emplace_back(path + ".moved", pathOf(item.first.first, settled));
    std::filesystem::rename(path, moves.back().first);
  }
  for (const auto& move : moves) std::filesystem::rename(move.first, move.second);
}

}  // namespace sunlit::evaluate
