#include "evaluate/picture_writer.h"

#include <cstdio>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <vector>

#include "sunlit/image/files.h"

namespace sunlit::evaluate {
namespace {

constexpr std::size_t kMostWaiting = 64;

void writePng(const std::string& path, const cv::Mat& rgb) {
  cv::Mat bgr;
  cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
  std::filesystem::create_directories(std::filesystem::path(path).parent_path());
  // In memory first: OpenCV does not notice where the last of a file finds no room on the disk.
  std::vector<unsigned char> bytes;
  if (!cv::imencode(".png", bgr, bytes))
    throw std::runtime_error(path + ": OpenCV cannot encode this picture");
  image::writeFileAtomically(path, std::string(bytes.begin(), bytes.end()));
}

}  // namespace

PictureWriter::PictureWriter(const std::string& folder) : folder_(folder), thread_([this] { run(); }) {}

PictureWriter::~PictureWriter() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_closed_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

std::string PictureWriter::pathOf(const std::string& stream, std::int64_t pose) const {
  char name[40];
  std::snprintf(name, sizeof name, "%06lld.png", static_cast<long long>(pose));
  return folder_ + "/" + stream + "/" + name;
}

void PictureWriter::write(const std::string& stream, std::int64_t pose, std::int64_t stamp_ns,
                          const cv::Mat& rgb) {
  const std::string path = pathOf(stream, pose);
  std::unique_lock<std::mutex> lock(mutex_);
  stamps_[{stream, pose}] = stamp_ns;
  if (std::filesystem::exists(path)) return;
  changed_.wait(lock, [this] { return tasks_.size() < kMostWaiting || is_closed_; });
  tasks_.push_back({path, rgb});
  changed_.notify_all();
}

void PictureWriter::run() {
  std::unique_lock<std::mutex> lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return is_closed_ || !tasks_.empty(); });
    if (tasks_.empty()) return;
    const Task task = std::move(tasks_.front());
    tasks_.pop_front();
    changed_.notify_all();
    lock.unlock();
    std::string fault;
    try {
      writePng(task.path, task.rgb);
    } catch (const std::exception& error) {
      fault = error.what();
    }
    lock.lock();
    if (fault_.empty()) fault_ = fault;
  }
}

void PictureWriter::finish(const std::function<std::int64_t(std::int64_t, std::int64_t)>& settled_pose) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_closed_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
  if (!fault_.empty()) throw std::runtime_error(fault_);

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
