/// Where in a picture features are lost: which of those of a have no right match in b.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "sunlit/evaluate/files/frames_file.h"
#include "sunlit/evaluate/verify/verify.h"

namespace sunlit::evaluate {

/// Cells of a picture, row by row from the top left.
constexpr std::size_t kLostColumns = 16;
constexpr std::size_t kLostRows = 12;

struct LostFeatures {
  template <typename Count>
  using Cells = std::array<Count, kLostColumns * kLostRows>;
  /// At most 65,535 a cell.
  Cells<std::uint16_t> features{};  ///< of a whose point b shows
  Cells<std::uint16_t> lost{};  ///< of them: those without a match that passes the ratio test and is right
};

/// `accepted` of `features` by the same maps, see acceptedMatches().
LostFeatures lostFeatures(const FeaturePair& features, const std::vector<AcceptedMatch>& accepted,
                          const PointMaps& maps, const PictureSize& size_a);

/// The bytes by which one pair of one pose stands in a file of them, which begins with lostFileHeader() and a
/// line end; `name` and pair index the layout.
std::string lostFileHeader();
std::string lostRecordOf(std::int64_t stamp_ns, std::size_t pair, std::size_t name, const LostFeatures& lost);
/// Whether there is such a file with records.
bool holdsLost(const std::string& path);
/// Cuts off a torn end; the bytes that it had. Nothing where there is no file. Throws std::runtime_error for
/// a file of another kind.
std::size_t mendLostFile(const std::string& path);

/// Over all poses, by pair and name.
struct LostSum {
  std::size_t poses = 0;
  LostFeatures::Cells<std::uint64_t> features{};
  LostFeatures::Cells<std::uint64_t> lost{};
};

/// [pair * names + name]: sums of those records of `files` that `counts`, each once.
std::vector<LostSum> sumsOfLost(const std::vector<std::string>& files, const FramesLayout& layout,
                                const std::function<bool(std::int64_t stamp_ns, std::size_t pair)>& counts);

/// lost_features.csv: a,b,detector,poses,column,row,features,lost, a line a cell, of those pairs that have
/// poses. In one step.
void writeLost(const std::string& path, const FramesLayout& layout, const std::vector<LostSum>& sums);

}  // namespace sunlit::evaluate
