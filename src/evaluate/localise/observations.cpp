// Record: kMagic, bytes of the payload, payload. Numbers as the processor has them: a run's files stay where
// it ran.
#include "sunlit/evaluate/localise/observations.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <opencv2/core.hpp>
#include <stdexcept>
#include <utility>

#include "sunlit/image/files.h"

namespace sunlit::evaluate {
namespace {

constexpr std::uint64_t kMagic = 0x32736265746c6e73;  // "snltebs2"
constexpr std::uint64_t kHead = 2 * sizeof(std::uint64_t);
constexpr std::uint64_t kLongestHead = 4096;  // names of streams and detectors are far shorter

[[noreturn]] void failWith(const std::string& path, const std::string& what) {
  throw std::runtime_error(path + ": " + what + ": " + image::reasonOf(errno));
}

class Writer {
 public:
  template <typename Value>
  void put(const Value& value) {
    static_assert(std::is_trivially_copyable_v<Value>);
    put(&value, sizeof value);
  }
  void put(const void* data, std::size_t bytes) { bytes_.append(static_cast<const char*>(data), bytes); }
  void put(const std::string& text) {
    put(static_cast<std::uint64_t>(text.size()));
    put(text.data(), text.size());
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

class Reader {
 public:
  Reader(const std::string& bytes, const std::string& path) : bytes_(bytes), path_(path) {}
  template <typename Value>
  Value get() {
    Value value;
    get(&value, sizeof value);
    return value;
  }
  void get(void* data, std::size_t bytes) {
    if (bytes > bytes_.size() - at_) throw std::runtime_error(path_ + ": holds a record that is cut off");
    if (bytes > 0) std::memcpy(data, bytes_.data() + at_, bytes);
    at_ += bytes;
  }
  /// How many of so many bytes each follow, which must all be there.
  std::size_t count(std::size_t bytes_each) {
    const auto count = get<std::uint64_t>();
    if (count > (bytes_.size() - at_) / bytes_each)
      throw std::runtime_error(path_ + ": holds a record that is cut off");
    return static_cast<std::size_t>(count);
  }
  /// Refuses a record whose parts do not fit each other.
  void require(bool fits) const {
    if (!fits) throw std::runtime_error(path_ + ": holds a record whose numbers of features do not fit");
  }
  std::size_t left() const { return bytes_.size() - at_; }
  std::string text() {
    std::string text(count(1), '\0');
    get(text.data(), text.size());
    return text;
  }

 private:
  const std::string& bytes_;
  const std::string& path_;
  std::size_t at_ = 0;
};

void putKey(Writer& out, const ObservationKey& key) {
  out.put(key.stream);
  out.put(key.detector);
  out.put(key.pose);
  out.put(key.stamp_ns);
}

ObservationKey takeKey(Reader& in) {
  ObservationKey key;
  key.stream = in.text();
  key.detector = in.text();
  key.pose = in.get<std::int64_t>();
  key.stamp_ns = in.get<std::int64_t>();
  return key;
}

void putHead(Writer& out, const Observation& observation) {
  out.put(observation.camera);
  const Eigen::Matrix4d pose = observation.map_from_optical.matrix();
  out.put(pose.data(), sizeof(double) * 16);
  out.put(observation.ev100);
}

ObservationHead takeHead(Reader& in) {
  ObservationHead head;
  head.camera = in.get<image::PinholeCamera>();
  Eigen::Matrix4d pose;
  in.get(pose.data(), sizeof(double) * 16);
  head.map_from_optical.matrix() = pose;
  head.ev100 = in.get<double>();
  return head;
}

void putPlaces(Writer& out, const Observation& observation) {
  out.put(static_cast<std::uint64_t>(observation.features.key_points.size()));
  for (const cv::KeyPoint& key_point : observation.features.key_points) {
    out.put(key_point.pt.x);
    out.put(key_point.pt.y);
    out.put(key_point.response);
  }
  out.put(static_cast<std::uint64_t>(observation.points.size()));
  for (const Eigen::Vector3d& point : observation.points) out.put(point.data(), sizeof(double) * 3);
}

void takePlaces(Reader& in, Observation& observation) {
  observation.features.key_points.resize(in.count(3 * sizeof(float)));
  for (cv::KeyPoint& key_point : observation.features.key_points) {
    key_point.pt.x = in.get<float>();
    key_point.pt.y = in.get<float>();
    key_point.response = in.get<float>();
  }
  observation.points.resize(in.count(sizeof(double) * 3));
  in.require(observation.points.empty() ||
             observation.points.size() == observation.features.key_points.size());
  for (Eigen::Vector3d& point : observation.points) in.get(point.data(), sizeof(double) * 3);
}

void putDescriptors(Writer& out, const cv::Mat& descriptors) {
  const cv::Mat compact = compactDescriptors(descriptors);
  out.put(descriptors.type());
  out.put(compact.type());
  out.put(compact.rows);
  out.put(compact.cols);
  const std::size_t row_bytes = static_cast<std::size_t>(compact.cols) * compact.elemSize();
  for (int i = 0; i < compact.rows; ++i) out.put(compact.ptr(i), row_bytes);
}

/// One a key point.
cv::Mat takeDescriptors(Reader& in, std::size_t key_points) {
  const int type = in.get<int>();
  const int compact_type = in.get<int>();
  const int rows = in.get<int>();
  const int columns = in.get<int>();
  in.require(rows >= 0 && columns >= 0 && static_cast<std::size_t>(rows) == key_points &&
             type == CV_MAT_TYPE(type) && compact_type == CV_MAT_TYPE(compact_type));
  const std::size_t row_bytes = static_cast<std::size_t>(columns) * CV_ELEM_SIZE(compact_type);
  in.require(rows == 0 || row_bytes <= in.left() / static_cast<std::size_t>(rows));
  cv::Mat compact(rows, columns, compact_type);
  for (int i = 0; i < rows; ++i) in.get(compact.ptr(i), row_bytes);
  if (type == compact_type) return compact;
  cv::Mat descriptors;
  compact.convertTo(descriptors, type);
  return descriptors;
}

std::string payloadOf(const ObservationKey& key, const Observation& observation) {
  Writer out;
  putKey(out, key);
  putHead(out, observation);
  putPlaces(out, observation);
  putDescriptors(out, observation.features.descriptors);
  return out.bytes();
}

bool writeAt(int descriptor, const std::string& bytes, std::uint64_t offset) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t put =
        ::pwrite(descriptor, bytes.data() + done, bytes.size() - done, static_cast<off_t>(offset + done));
    if (put < 0 && errno == EINTR) continue;
    if (put < 0) return false;
    done += static_cast<std::size_t>(put);
  }
  return true;
}

}  // namespace

ObservationFile::ObservationFile(const std::string& path, ObservationUse use) : path_(path), use_(use) {
  const int flags = use == ObservationUse::kGrow ? O_RDWR | O_CREAT : O_RDONLY;
  descriptor_ = ::open(path.c_str(), flags | O_CLOEXEC, 0644);
  if (descriptor_ < 0) failWith(path, "cannot be opened");
  try {
    scan();
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

ObservationFile::~ObservationFile() {
  ::close(descriptor_);
}

// False where the file ends before that.
bool ObservationFile::readAt(void* data, std::size_t bytes, std::uint64_t offset) const {
  std::size_t done = 0;
  while (done < bytes) {
    const ssize_t got = ::pread(descriptor_, static_cast<char*>(data) + done, bytes - done,
                                static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) failWith(path_, "cannot be read");
    if (got == 0) return false;
    done += static_cast<std::size_t>(got);
  }
  return true;
}

void ObservationFile::scan() {
  struct stat status {};
  if (::fstat(descriptor_, &status) != 0) failWith(path_, "cannot be read");
  const auto size = static_cast<std::uint64_t>(status.st_size);
  std::uint64_t head[2];
  while (size - end_ >= kHead && readAt(head, sizeof head, end_)) {
    if (head[0] != kMagic)
      throw std::runtime_error(
          path_ + ": is not a file of observations of this version; another output folder is needed");
    if (head[1] > size - end_ - kHead) break;
    Entry entry{{}, end_, head[1]};
    const std::string bytes = payload(entry, std::min(entry.bytes, kLongestHead));
    Reader in(bytes, path_);
    entry.key = takeKey(in);
    append(entry);
  }
  cutOff(size);
}

void ObservationFile::cutOff(std::uint64_t size) {
  torn_ = static_cast<std::size_t>(size - end_);
  if (torn_ == 0) return;
  if (use_ == ObservationUse::kRead) throw std::runtime_error(path_ + ": holds a record that is cut off");
  if (::ftruncate(descriptor_, static_cast<off_t>(end_)) != 0)
    failWith(path_, "its torn end cannot be cut off");
}

std::string ObservationFile::payload(const Entry& entry, std::uint64_t beginning) const {
  std::string bytes(beginning, '\0');
  if (!readAt(bytes.data(), bytes.size(), entry.offset + kHead)) failWith(path_, "cannot be read");
  return bytes;
}

void ObservationFile::add(const ObservationKey& key, const Observation& observation) {
  const std::string bytes = payloadOf(key, observation);
  Writer record;
  record.put(kMagic);
  record.put(static_cast<std::uint64_t>(bytes.size()));
  record.put(bytes.data(), bytes.size());
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!writeAt(descriptor_, record.bytes(), end_)) {
    const int reason = errno;
    const bool is_mended = ::ftruncate(descriptor_, static_cast<off_t>(end_)) == 0;
    errno = reason;
    failWith(path_, is_mended ? "cannot be written" : "cannot be written, and ends torn");
  }
  append({key, end_, bytes.size()});
}

void ObservationFile::append(const Entry& entry) {
  entries_.push_back(entry);
  held_.emplace(entry.key.stream, entry.key.detector, entry.key.pose);
  end_ += kHead + entry.bytes;
}

bool ObservationFile::holds(const std::string& stream, const std::string& detector, std::int64_t pose) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return held_.count({stream, detector, pose}) > 0;
}

std::vector<ObservationKey> ObservationFile::keys() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<ObservationKey> keys;
  for (const Entry& entry : entries_) keys.push_back(entry.key);
  return keys;
}

std::uint64_t ObservationFile::bytes() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return end_;
}

ObservationFile::Entry ObservationFile::entryAt(std::size_t index) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return entries_.at(index);
}

Observation ObservationFile::read(std::size_t index) const {
  const Entry entry = entryAt(index);
  const std::string bytes = payload(entry, entry.bytes);
  Reader in(bytes, path_);
  takeKey(in);
  const ObservationHead head = takeHead(in);
  Observation observation;
  observation.camera = head.camera;
  observation.map_from_optical = head.map_from_optical;
  observation.ev100 = head.ev100;
  takePlaces(in, observation);
  observation.features.descriptors = takeDescriptors(in, observation.features.key_points.size());
  return observation;
}

ObservationHead ObservationFile::head(std::size_t index) const {
  const Entry entry = entryAt(index);
  const std::string bytes = payload(entry, std::min(entry.bytes, kLongestHead));
  Reader in(bytes, path_);
  takeKey(in);
  return takeHead(in);
}

}  // namespace sunlit::evaluate
