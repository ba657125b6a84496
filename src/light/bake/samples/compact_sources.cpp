#include "light/bake/samples/compact_sources.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <iterator>
#include <map>
#include <numeric>

#include "light/bake/samples/compact_shapes.h"

namespace sunlit::light {
namespace {

using Piece = AreaLights::Piece;

constexpr float kLargest_m = 1.5f;
constexpr std::size_t kMost = 256;
/// More pieces than that are no simple body.
constexpr std::size_t kSimplest = 20000;

/// Pieces that touch, each list in rising order.
class Touching {
 public:
  explicit Touching(const std::vector<Piece>& pieces) : parent_(pieces.size()) {
    std::iota(parent_.begin(), parent_.end(), 0u);
    std::map<std::array<std::uint32_t, 3>, std::uint32_t> first;
    for (std::uint32_t i = 0; i < pieces.size(); ++i) {
      for (const Eigen::Vector3f& corner : pieces[i].corner) {
        std::array<std::uint32_t, 3> bits{};
        const Eigen::Vector3f plain = corner.array() + 0.0f;  // no zero is below 0
        std::memcpy(bits.data(), plain.data(), sizeof bits);
        const auto [known, is_new] = first.emplace(bits, i);
        if (!is_new) join(known->second, i);
      }
    }
  }

  std::vector<std::vector<std::uint32_t>> lists() {
    std::map<std::uint32_t, std::vector<std::uint32_t>> of;
    for (std::uint32_t i = 0; i < parent_.size(); ++i) of[root(i)].push_back(i);
    std::vector<std::vector<std::uint32_t>> all;
    for (auto& [key, list] : of) all.push_back(std::move(list));
    return all;
  }

 private:
  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }
  std::vector<std::uint32_t> parent_;
};

/// Whether others near it, of other bodies, give so much more where a source lights what is below it that its
/// shadows hardly show there.
bool isCrowded(const std::vector<CompactShape>& all, const CompactShape& one, float height_m) {
  constexpr float kCrowd = 3.0f;
  float others = 0.0f;
  for (const CompactShape& other : all) {
    if (other.body == one.body) continue;
    const float away_m2 = (other.source.position - one.source.position).squaredNorm();
    const float share = height_m * height_m / (height_m * height_m + away_m2);
    others += other.power * share * share;
  }
  return others > kCrowd * one.power;
}

/// Calls `visit` with each member of a CompactSource that is more than one number.
template <typename Source, typename Visit>
void eachNumbersOf(Source& source, const Visit& visit) {
  visit(source.position);
  visit(source.intensity);
  visit(source.normal);
  visit(source.shape);
  visit(source.half);
}
static_assert(sizeof(KeptSource) == (3 + 3 + 3 + 9 + 6 + 4) * sizeof(float), "as many as are kept");

}  // namespace

KeptSource kept(const CompactSource& source) {
  KeptSource all{};
  float* at = all.data();
  eachNumbersOf(source, [&](const auto& numbers) { at = std::copy_n(numbers.data(), numbers.size(), at); });
  at[0] = source.radius_m;
  at[1] = source.reach_m;
  at[2] = source.uneven_m;
  at[3] = source.round ? 1.0f : 0.0f;
  return all;
}

CompactSource sourceOf(const KeptSource& kept) {
  CompactSource source{};
  const float* at = kept.data();
  eachNumbersOf(source, [&](auto& numbers) {
    std::copy_n(at, numbers.size(), numbers.data());
    at += numbers.size();
  });
  source.radius_m = at[0];
  source.reach_m = at[1];
  source.uneven_m = at[2];
  source.round = at[3] > 0.0f;
  return source;
}

ShiningParts partedBySize(const std::vector<Piece>& pieces, float height_m) {
  const std::vector<std::vector<std::uint32_t>> bodies = Touching(pieces).lists();
  std::vector<CompactShape> found;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i].size() > kSimplest) continue;
    std::vector<CompactShape> of_body = compactShapes(pieces, bodies[i], kLargest_m);
    for (CompactShape& one : of_body) one.body = i;
    std::move(of_body.begin(), of_body.end(), std::back_inserter(found));
  }
  // Both sides of a flat part are next to each other, and stay or go together.
  std::stable_sort(found.begin(), found.end(),
                   [](const CompactShape& a, const CompactShape& b) { return a.power > b.power; });
  if (found.size() > kMost) found.resize(found[kMost].pieces.empty() ? kMost - 1 : kMost);
  ShiningParts parts;
  std::vector<bool> is_compact(pieces.size(), false);
  for (const CompactShape& one : found) {
    if (isCrowded(found, one, height_m)) continue;
    parts.compact.push_back(one.source);
    for (const std::uint32_t i : one.pieces) is_compact[i] = true;
  }
  for (std::size_t i = 0; i < pieces.size(); ++i)
    (is_compact[i] ? parts.of_compact : parts.others).push_back(pieces[i]);
  return parts;
}

}  // namespace sunlit::light
