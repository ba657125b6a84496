#include "sunlit/evaluate/verify/lost_features.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>
#include <stdexcept>
#include <tuple>

#include "sunlit/image/files.h"

namespace sunlit::evaluate {
namespace {

/// As it stands in the file.
struct Record {
  std::int64_t stamp_ns;
  std::uint32_t pair;
  std::uint32_t name;
  LostFeatures lost;
};
static_assert(sizeof(Record) == 16 + 4 * kLostColumns * kLostRows, "no gaps, whatever the compiler");

// Of the part of a picture that begins half a pixel before its first pixel's centre.
std::size_t stepOf(double place, int size, std::size_t steps) {
  const double step = (place + 0.5) / size * static_cast<double>(steps);
  return static_cast<std::size_t>(std::clamp(step, 0.0, static_cast<double>(steps - 1)));
}

void count(std::uint16_t& cell) {
  if (cell < std::numeric_limits<std::uint16_t>::max()) ++cell;
}

}  // namespace

LostFeatures lostFeatures(const FeaturePair& features, const std::vector<AcceptedMatch>& accepted,
                          const PointMaps& maps, const PictureSize& size_a) {
  const std::vector<cv::KeyPoint>& points = features.a.key_points;
  std::vector<char> is_kept(points.size(), 0);
  for (const AcceptedMatch& match : accepted) {
    if (match.is_right) is_kept[match.a] = 1;
  }
  LostFeatures result;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!maps.b_from_a({points[i].pt.x, points[i].pt.y})) continue;
    const std::size_t cell = stepOf(points[i].pt.y, size_a.height, kLostRows) * kLostColumns +
                             stepOf(points[i].pt.x, size_a.width, kLostColumns);
    count(result.features[cell]);
    if (!is_kept[i]) count(result.lost[cell]);
  }
  return result;
}

std::string lostFileHeader() {
  return "sunlit lost features, 1";
}

std::string lostRecordOf(std::int64_t stamp_ns, std::size_t pair, std::size_t name,
                         const LostFeatures& lost) {
  const Record record{stamp_ns, static_cast<std::uint32_t>(pair), static_cast<std::uint32_t>(name), lost};
  std::string bytes(sizeof record, '\0');
  std::memcpy(bytes.data(), &record, sizeof record);
  return bytes;
}

bool holdsLost(const std::string& path) {
  return std::filesystem::exists(path) && std::filesystem::file_size(path) > lostFileHeader().size() + 1;
}

std::size_t mendLostFile(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return 0;
  std::string first;
  std::getline(file, first);
  const std::uintmax_t size = std::filesystem::file_size(path);
  const std::uintmax_t head = lostFileHeader().size() + 1;
  if (size < head) {  // torn in its first line
    std::filesystem::resize_file(path, 0);
    return size;
  }
  if (first != lostFileHeader())
    throw std::runtime_error(
        path + ": is not a file of lost features of this version; another output folder is needed");
  const std::uintmax_t torn = (size - head) % sizeof(Record);
  if (torn > 0) std::filesystem::resize_file(path, size - torn);
  return torn;
}

std::vector<LostSum> sumsOfLost(const std::vector<std::string>& files, const FramesLayout& layout,
                                const std::function<bool(std::int64_t stamp_ns, std::size_t pair)>& counts) {
  const std::size_t names = layout.differences.size();
  std::vector<LostSum> sums(layout.pairs.size() * names);
  std::set<std::tuple<std::int64_t, std::uint32_t, std::uint32_t>> seen;
  for (const std::string& path : files) {
    if (!std::filesystem::exists(path)) continue;
    std::ifstream file(path, std::ios::binary);
    std::string first;
    std::getline(file, first);
    Record record;
    while (file.read(reinterpret_cast<char*>(&record), sizeof record)) {
      if (record.pair >= layout.pairs.size() || record.name >= names)
        throw std::runtime_error(path + ": is of other pairs or detectors");
      if (!counts(record.stamp_ns, record.pair)) continue;
      if (!seen.emplace(record.stamp_ns, record.pair, record.name).second) continue;
      LostSum& sum = sums[record.pair * names + record.name];
      ++sum.poses;
      for (std::size_t cell = 0; cell < sum.lost.size(); ++cell) {
        sum.features[cell] += record.lost.features[cell];
        sum.lost[cell] += record.lost.lost[cell];
      }
    }
    if (file.bad() || !file.eof()) throw std::runtime_error(path + ": cannot be read");
  }
  return sums;
}

void writeLost(const std::string& path, const FramesLayout& layout, const std::vector<LostSum>& sums) {
  std::string text = "a,b,detector,poses,column,row,features,lost\n";
  for (std::size_t i = 0; i < sums.size(); ++i) {
    if (sums[i].poses == 0) continue;
    const auto& pair = layout.pairs[i / layout.differences.size()];
    const std::string start = pair.first + "," + pair.second + "," +
                              layout.differences[i % layout.differences.size()] + "," +
                              std::to_string(sums[i].poses) + ",";
    for (std::size_t cell = 0; cell < sums[i].lost.size(); ++cell) {
      text += start + std::to_string(cell % kLostColumns) + "," + std::to_string(cell / kLostColumns) + "," +
              std::to_string(sums[i].features[cell]) + "," + std::to_string(sums[i].lost[cell]) + "\n";
    }
  }
  image::writeFileAtomically(path, text);
}

}  // namespace sunlit::evaluate
