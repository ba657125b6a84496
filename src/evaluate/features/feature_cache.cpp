#include "sunlit/evaluate/features/feature_cache.h"

#include <dlfcn.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <opencv2/core/utility.hpp>
#include <stdexcept>
#include <system_error>

#include "sunlit/image/content_hash.h"
#include "sunlit/image/files.h"
#include "sunlit/quantity/memory.h"

namespace sunlit::evaluate {
namespace {

namespace fs = std::filesystem;
using image::ContentHash;

/// To be raised where the file has another form.
constexpr std::uint32_t kVersion = 1;
constexpr char kMagic[8] = {'s', 'u', 'n', 'l', 'i', 't', 'F', '\n'};
constexpr const char* kEnding = ".features";
constexpr double kBytesPerGigabyte = 1e9;

struct Header {
  char magic[8];
  std::uint32_t version;
  std::uint32_t points;
  std::int32_t rows, columns, type;  ///< of the descriptors
  std::uint32_t unused;
  ContentHash::Number checksum;  ///< of the key, of what stands above, and of all that follows
};
static_assert(sizeof(Header) == 48, "no padding goes to the file");
static_assert(sizeof(cv::KeyPoint) == 28, "no padding goes to the file");

[[noreturn]] void fail(const fs::path& file, const std::string& what) {
  throw std::runtime_error(file.string() + ": " + what);
}

/// Of a whole file.
ContentHash::Number checksumOf(const std::string& key, const std::string& bytes) {
  ContentHash hash;
  hash.addBytes(key.data(), key.size());
  hash.addBytes(bytes.data(), offsetof(Header, checksum));
  hash.addBytes(bytes.data() + sizeof(Header), bytes.size() - sizeof(Header));
  return hash.number();
}

std::string bytesOf(const std::string& key, const Features& features) {
  const cv::Mat whole =
      features.descriptors.isContinuous() ? features.descriptors : features.descriptors.clone();
  const std::size_t point_bytes = features.key_points.size() * sizeof(cv::KeyPoint);
  const std::size_t descriptor_bytes = whole.total() * whole.elemSize();
  std::string bytes(sizeof(Header) + point_bytes + descriptor_bytes, '\0');
  char* const data = bytes.data() + sizeof(Header);
  if (point_bytes > 0) std::memcpy(data, features.key_points.data(), point_bytes);
  if (descriptor_bytes > 0) std::memcpy(data + point_bytes, whole.data, descriptor_bytes);
  Header header{};
  std::memcpy(header.magic, kMagic, sizeof(kMagic));
  header.version = kVersion;
  header.points = static_cast<std::uint32_t>(features.key_points.size());
  header.rows = whole.rows;
  header.columns = whole.cols;
  header.type = whole.type();
  std::memcpy(bytes.data(), &header, sizeof(header));
  header.checksum = checksumOf(key, bytes);
  std::memcpy(bytes.data(), &header, sizeof(header));
  return bytes;
}

/// Whether what follows the header is as long as the header says. The checksum is no proof of that: it finds
/// what was damaged, not what was written wrongly.
bool fits(const Header& header, std::size_t bytes) {
  if (header.rows < 0 || header.columns < 0 || header.type != CV_MAT_TYPE(header.type)) return false;
  const std::uint64_t points = std::uint64_t{header.points} * sizeof(cv::KeyPoint);
  const std::uint64_t numbers =
      static_cast<std::uint64_t>(header.rows) * static_cast<std::uint64_t>(header.columns);
  const std::uint64_t each = CV_ELEM_SIZE(header.type);
  if (points > bytes || numbers > bytes) return false;
  return points + numbers * each == bytes &&
         (numbers == 0 ? header.points == 0 : static_cast<std::uint32_t>(header.rows) == header.points);
}

Features featuresOf(const fs::path& file, const std::string& key) {
  const std::string bytes = image::readWholeFile(file.string());
  Header header;
  if (bytes.size() < sizeof(header)) fail(file, "is cut short");
  std::memcpy(&header, bytes.data(), sizeof(header));
  if (std::memcmp(header.magic, kMagic, sizeof(kMagic)) != 0 || header.version != kVersion)
    fail(file, "holds no features of this version");
  const char* const data = bytes.data() + sizeof(header);
  if (checksumOf(key, bytes) != header.checksum) fail(file, "is damaged");
  if (!fits(header, bytes.size() - sizeof(header)))
    fail(file, "holds other numbers of features than it says");
  Features features;
  const std::size_t point_bytes = header.points * sizeof(cv::KeyPoint);
  const std::size_t descriptor_bytes = bytes.size() - sizeof(header) - point_bytes;
  features.key_points.resize(header.points);
  if (point_bytes > 0) std::memcpy(static_cast<void*>(features.key_points.data()), data, point_bytes);
  features.descriptors.create(header.rows, header.columns, header.type);
  if (descriptor_bytes > 0) std::memcpy(features.descriptors.data, data + point_bytes, descriptor_bytes);
  return features;
}

/// Not made durable: what a crash of the machine damages is found by its checksum.
void write(const fs::path& file, const std::string& bytes) {
  const fs::path unfinished = file.string() + "." + std::to_string(getpid()) + ".part";
  errno = 0;
  std::ofstream stream(unfinished, std::ios::binary | std::ios::trunc);
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  stream.close();
  std::string reason = errno != 0 ? ": " + image::reasonOf(errno) : "";
  if (stream) {
    std::error_code error;
    fs::rename(unfinished, file, error);
    if (!error) return;
    reason = ": " + error.message();
  }
  std::error_code ignored;
  fs::remove(unfinished, ignored);
  fail(file, "cannot be written" + reason);
}

/// Of the library that holds our detectors and preprocessing: after any change of them all is found anew, and
/// nobody has to think of it. Where it cannot be read, nothing is shared with other processes.
std::string ourCode() {
  ContentHash hash;
  Dl_info where{};
  const bool is_known = dladdr(reinterpret_cast<const void*>(&featureKey), &where) != 0 &&
                        where.dli_fname != nullptr && hash.addFile(where.dli_fname);
  if (!is_known) {
    hash.add(getpid());
    hash.add(std::chrono::system_clock::now().time_since_epoch().count());
  }
  return SUNLIT_VERSION + hash.text();
}

/// Of all that is the same for every picture in this process.
const std::string& machine() {
  static const std::string text = ourCode() + cv::getBuildInformation() + cv::getCPUFeaturesLine();
  return text;
}

}  // namespace

std::string featureKey(const std::string& identity, const cv::Mat& seen) {
  ContentHash hash;
  hash.add(kVersion);
  for (const std::string* text : {&machine(), &identity}) {
    hash.add(static_cast<std::uint64_t>(text->size()));
    hash.addBytes(text->data(), text->size());
  }
  hash.add(seen.cols);
  hash.add(seen.rows);
  for (int y = 0; y < seen.rows; ++y) hash.addBytes(seen.ptr(y), static_cast<std::size_t>(seen.cols));
  return hash.text();
}

FeatureCache::FeatureCache(const std::string& folder, std::uintmax_t limit_bytes, Log log)
    : folder_{folder, kEnding},
      limit_bytes_(limit_bytes),
      log_(std::move(log)),
      start_(fs::file_time_type::clock::now()) {
  machine();  // now, lest another build takes the library's place before the first picture comes
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    stopKeeping(folder + ": " + error.message());
  } else if (access(folder.c_str(), W_OK) != 0) {
    stopKeeping(folder + ": " + std::strerror(errno));
  } else {
    bytes_ = folder_.tidy(
        limit_bytes_, [this](const std::string& line) { say(line); }, start_);
  }
}

FeatureCache::~FeatureCache() = default;

std::shared_ptr<FeatureCache> FeatureCache::usual(double limit_gb, Log log) {
  if (limit_gb == 0.0) return nullptr;
  return std::make_shared<FeatureCache>(image::usualCacheFolder() + "/features",
                                        static_cast<std::uintmax_t>(kBytesPerGigabyte * limit_gb),
                                        std::move(log));
}

std::optional<Features> FeatureCache::find(const std::string& key) {
  const fs::path file = folder_.path / (key + kEnding);
  std::error_code error;
  if (!fs::exists(file, error)) return std::nullopt;
  try {
    const image::CacheUse in_use(file);
    Features features = featuresOf(file, key);
    ++found_;
    return features;
  } catch (const std::exception& problem) {
    if (fs::exists(file, error)) sayUnreadable(reasonInWords(problem));
    return std::nullopt;
  }
}

void FeatureCache::keep(const std::string& key, const Features& features) {
  if (!is_keeping_) return;
  const fs::path file = folder_.path / (key + kEnding);
  const std::string bytes = bytesOf(key, features);
  if (!takeRoom(bytes.size())) return;
  try {
    const std::optional<image::CacheTurn> turn = image::CacheTurn::ifFree(file);
    if (turn) write(file, bytes);  // otherwise somebody keeps the same just now
  } catch (const std::exception& problem) {
    stopKeeping(reasonInWords(problem));
  }
}

// Never beyond the limit: the next run would begin with removing what this one has kept first. Some more room
// is made than is needed, so that it is not needed again at once.
bool FeatureCache::takeRoom(std::uintmax_t bytes) {
  if ((bytes_ += bytes) <= limit_bytes_) return true;
  const std::unique_lock<std::mutex> lock(room_mutex_, std::try_to_lock);
  if (lock) {
    const std::uintmax_t spare = std::max(bytes, limit_bytes_ / 16);
    bytes_ = bytes + folder_.tidy(
                         limit_bytes_ - std::min(limit_bytes_, spare),
                         [this](const std::string& line) { say(line); }, start_);
    if (bytes_ <= limit_bytes_) return true;
    char limit[32];
    std::snprintf(limit, sizeof limit, "%g", static_cast<double>(limit_bytes_) / kBytesPerGigabyte);
    stopKeeping(folder_.path.string() + " has reached the limit of " + limit + " GB with those of this run");
  }
  bytes_ -= bytes;
  return false;
}

void FeatureCache::stopKeeping(const std::string& why) {
  if (is_keeping_.exchange(false)) say("features are not kept for other runs: " + why);
}

void FeatureCache::sayUnreadable(const std::string& why) {
  const std::size_t count = ++unreadable_;
  std::size_t told = 1;
  while (told < count) told *= 10;
  if (told != count) return;
  say("features are found anew: " + why +
      (count > 1 ? "; so far " + std::to_string(count) + " files of them" : ""));
}

void FeatureCache::say(const std::string& line) {
  const std::lock_guard<std::mutex> lock(log_mutex_);
  if (log_) log_(line);
}

Field featuresCacheRow(double* limit_gb) {
  return {"features_cache_limit",
          limit_gb,
          "GB",
          {0, 1e6},
          "that features may take in the folder of what is kept, for other runs; 0: none are kept"};
}

}  // namespace sunlit::evaluate
