#include "light/bake/samples/compact_sources.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <optional>

#include "light/patches/even_directions.h"
#include "sunlit/quantity/angle.h"
#include "sunlit/quantity/photometry.h"

namespace sunlit::light {
namespace {

using Piece = AreaLights::Piece;

constexpr float kLargest_m = 1.5f;
constexpr std::size_t kMost = 256;
/// More pieces than that are no simple body.
constexpr std::size_t kSimplest = 20000;
/// Of a body's intensity to any side; and of a flat part's area.
constexpr float kAlike = 0.1f, kAlikeArea = 0.1f;
/// Of a body's radius: how far it may reach.
constexpr float kLongest = 2.0f;
/// Of the power of pieces that face outward in a body.
constexpr float kOutward = 0.95f;
/// Cosine of the angle between normals of a flat part; and how uneven it may be, of its reach.
constexpr float kFlat = 0.985f, kUneven = 0.1f;
/// Of a body's power: what no face of it has may be so much, and is baked.
constexpr float kFaint = 0.05f;
constexpr std::size_t kDirections = 32;

/// A source and the pieces whose light it has.
struct Found {
  CompactSource source;
  float power = 0.0f;
  std::vector<std::uint32_t> pieces;
  std::size_t body = 0;
};

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

/// Sums over pieces, by what they give.
struct Sums {
  Sums(const std::vector<Piece>& pieces, const std::vector<std::uint32_t>& list) {
    Eigen::Vector3d weighted = Eigen::Vector3d::Zero();
    double all = 0.0;
    for (const std::uint32_t i : list) {
      const Piece& piece = pieces[i];
      const double weight = static_cast<double>(piece.power());
      all += weight;
      weighted += weight * piece.middle().cast<double>();
      intensity += piece.area_m2() * piece.luminance;
      area_m2 += piece.area_m2();
    }
    power = static_cast<float>(all);
    middle = (weighted / std::max(all, 1e-30)).cast<float>();
    for (const std::uint32_t i : list)
      for (const Eigen::Vector3f& corner : pieces[i].corner)
        reach_m = std::max(reach_m, (corner - middle).norm());
  }
  float power = 0.0f, area_m2 = 0.0f, reach_m = 0.0f;
  Eigen::Vector3f middle = Eigen::Vector3f::Zero();
  Eigen::Array3f intensity = Eigen::Array3f::Zero();  ///< cd, if all faced the same place
};

/// Intensity to some sides of a body none of whose pieces hides another; none where it is no such body.
std::optional<Eigen::VectorXf> intensitiesOf(const std::vector<Piece>& pieces,
                                             const std::vector<std::uint32_t>& list, const Sums& sums,
                                             const std::vector<Eigen::Vector3f>& directions) {
  Eigen::VectorXf intensity = Eigen::VectorXf::Zero(static_cast<Eigen::Index>(directions.size()));
  float outward = 0.0f;
  for (const std::uint32_t i : list) {
    const Piece& piece = pieces[i];
    const Eigen::Vector3f out = piece.middle() - sums.middle;
    const bool away = piece.normal.dot(out) > 0.0f;
    if (!away && !piece.both) continue;
    const float power = piece.power();
    outward += power;
    for (std::size_t k = 0; k < directions.size(); ++k)
      intensity[static_cast<Eigen::Index>(k)] +=
          power * std::max((away ? 1.0f : -1.0f) * piece.normal.dot(directions[k]), 0.0f);
  }
  if (outward < kOutward * sums.power) return std::nullopt;
  return intensity;
}

/// As an ellipsoid, whose outline to a side w has an area of √(wᵀ M w).
std::optional<Found> asBody(const std::vector<Piece>& pieces, const std::vector<std::uint32_t>& list,
                            const Sums& sums) {
  static const std::vector<Eigen::Vector3f> directions = evenDirections(kDirections);
  const auto intensity = intensitiesOf(pieces, list, sums, directions);
  if (!intensity || !(intensity->minCoeff() > 0.0f)) return std::nullopt;
  Eigen::MatrixXf terms(static_cast<Eigen::Index>(kDirections), 6);
  for (std::size_t k = 0; k < kDirections; ++k) {
    const Eigen::Vector3f& w = directions[k];
    terms.row(static_cast<Eigen::Index>(k)) << w.x() * w.x(), w.y() * w.y(), w.z() * w.z(),
        2.0f * w.x() * w.y(), 2.0f * w.y() * w.z(), 2.0f * w.z() * w.x();
  }
  const Eigen::VectorXf squares = intensity->array().square();
  const Eigen::VectorXf m = terms.colPivHouseholderQr().solve(squares);
  const Eigen::VectorXf fitted = (terms * m).cwiseMax(0.0f).cwiseSqrt();
  if (((fitted - *intensity).array().abs() > kAlike * intensity->array()).any()) return std::nullopt;
  Eigen::Matrix3f shape;
  shape << m[0], m[3], m[5], m[3], m[1], m[4], m[5], m[4], m[2];
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> axes(shape, Eigen::EigenvaluesOnly);
  const float most = axes.eigenvalues()[2];
  if (!(axes.eigenvalues()[0] > 0.0f)) return std::nullopt;
  const float brightest = std::sqrt(most);  // of sums.power, which is that of all pieces
  const float radius_m = std::sqrt(sums.area_m2 * intensity->mean() / (sums.power * kPiFloat));
  if (sums.reach_m > kLongest * radius_m) return std::nullopt;
  Found found;
  found.source = {sums.middle,
                  sums.intensity * (brightest / sums.power),
                  Eigen::Vector3f::Zero(),
                  shape / most,
                  Eigen::Matrix<float, 3, 2>::Zero(),
                  false,
                  radius_m,
                  sums.reach_m,
                  0.0f};
  found.power = sums.power;
  found.pieces = list;
  return found;
}

/// Along the sides of the smallest rectangle around a flat part: one of them lies along an edge.
Eigen::Matrix<float, 3, 2> sidesOf(const std::vector<Piece>& pieces, const std::vector<std::uint32_t>& list,
                                   const Eigen::Vector3f& normal) {
  constexpr std::size_t kMostTried = 32;  // pieces
  Eigen::Matrix<float, 3, 2> best;
  best << normal.unitOrthogonal(), normal.cross(normal.unitOrthogonal());
  float least_m2 = std::numeric_limits<float>::infinity();
  const std::size_t step = (list.size() + kMostTried - 1) / kMostTried;
  for (std::size_t n = 0; n < list.size(); n += step) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& corner = pieces[list[n]].corner;
      const Eigen::Vector3f edge = corner[(k + 1) % 3] - corner[k];
      const Eigen::Vector3f flat = edge - normal.dot(edge) * normal;
      if (!(flat.norm() > 0.0f)) continue;
      Eigen::Matrix<float, 3, 2> sides;
      sides << flat.normalized(), normal.cross(flat.normalized());
      Eigen::AlignedBox2f box;
      for (const std::uint32_t i : list)
        for (const Eigen::Vector3f& at : pieces[i].corner)
          box.extend(Eigen::Vector2f(sides.transpose() * (at - corner[0])));
      const float area_m2 = box.diagonal().prod();
      if (area_m2 < least_m2) least_m2 = area_m2, best = sides;
    }
  }
  return best;
}

/// As a rectangle or an ellipse of its length and width; none where it is of another shape.
std::optional<CompactSource> asFlat(const std::vector<Piece>& pieces, const std::vector<std::uint32_t>& list,
                                    const Eigen::Vector3f& normal) {
  const Sums sums(pieces, list);
  const Eigen::Matrix<float, 3, 2> sides = sidesOf(pieces, list, normal);
  Eigen::Array2d squares = Eigen::Array2d::Zero();
  float uneven_m = 0.0f;
  for (const std::uint32_t i : list) {
    const Piece& piece = pieces[i];
    // Mean square over a triangle: of its corners and its middle, by a twelfth and three quarters.
    const auto add = [&](const Eigen::Vector3f& at, double share) {
      const Eigen::Array2d away = (sides.transpose() * (at - sums.middle)).cast<double>();
      squares += share * static_cast<double>(piece.power()) * away.square();
    };
    for (const Eigen::Vector3f& corner : piece.corner) {
      add(corner, 1.0 / 12.0);
      uneven_m = std::max(uneven_m, std::abs(normal.dot(corner - sums.middle)));
    }
    add(piece.middle(), 0.75);
  }
  if (uneven_m > kUneven * sums.reach_m) return std::nullopt;
  const Eigen::Vector2f deviations = (squares / static_cast<double>(sums.power)).sqrt().cast<float>();
  // Areas of a rectangle and an ellipse that are spread so.
  const float rectangle_m2 = 12.0f * deviations.prod(), ellipse_m2 = 4.0f * kPiFloat * deviations.prod();
  const bool round = std::abs(ellipse_m2 - sums.area_m2) < std::abs(rectangle_m2 - sums.area_m2);
  if (std::abs((round ? ellipse_m2 : rectangle_m2) - sums.area_m2) > kAlikeArea * sums.area_m2)
    return std::nullopt;
  const Eigen::Vector2f half = (round ? 2.0f : std::sqrt(3.0f)) * deviations;
  return CompactSource{sums.middle,
                       sums.intensity,
                       normal,
                       Eigen::Matrix3f::Identity(),
                       sides * half.asDiagonal(),
                       round,
                       std::sqrt(sums.area_m2 / kPiFloat),
                       sums.reach_m,
                       uneven_m};
}

/// Takes those that face as the most powerful of `list` does out of it.
std::vector<std::uint32_t> takeFace(const std::vector<Piece>& pieces, std::vector<std::uint32_t>* list) {
  const Piece& largest = pieces[*std::max_element(
      list->begin(), list->end(), [&](auto a, auto b) { return pieces[a].power() < pieces[b].power(); })];
  const auto end = std::stable_partition(list->begin(), list->end(), [&](std::uint32_t i) {
    return pieces[i].both == largest.both && pieces[i].normal.dot(largest.normal) > kFlat;
  });
  std::vector<std::uint32_t> face(list->begin(), end);
  list->erase(list->begin(), end);
  return face;
}

/// The faces of a body, if nearly all of its light is that of a few.
std::vector<Found> asFaces(const std::vector<Piece>& pieces, std::vector<std::uint32_t> list,
                           const Sums& body) {
  constexpr std::size_t kMostFaces = 6;
  std::vector<Found> found;
  float left = body.power;
  for (std::size_t face = 0; face < kMostFaces && left > kFaint * body.power; ++face) {
    Found one;
    one.pieces = takeFace(pieces, &list);
    for (const std::uint32_t i : one.pieces) one.power += pieces[i].power();
    left -= one.power;
    const Piece& first = pieces[one.pieces.front()];
    const std::optional<CompactSource> source = asFlat(pieces, one.pieces, first.normal);
    if (!source) return {};
    one.source = *source;
    found.push_back(one);
    if (!first.both) continue;
    one.source.normal = -one.source.normal;
    one.pieces.clear();  // of the other side
    found.push_back(one);
  }
  if (left > kFaint * body.power) return {};
  return found;
}

/// Whether others near it, of other bodies, give so much more where a source lights what is below it that its
/// shadows hardly show there.
bool isCrowded(const std::vector<Found>& all, const Found& one, float height_m) {
  constexpr float kCrowd = 3.0f;
  float others = 0.0f;
  for (const Found& other : all) {
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
  std::vector<Found> found;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i].size() > kSimplest) continue;
    const Sums sums(pieces, bodies[i]);
    if (!(sums.power > 0.0f) || sums.reach_m > kLargest_m) continue;
    std::vector<Found> of_body;
    if (std::optional<Found> body = asBody(pieces, bodies[i], sums))
      of_body.push_back(std::move(*body));
    else
      of_body = asFaces(pieces, bodies[i], sums);
    for (Found& one : of_body) one.body = i;
    std::move(of_body.begin(), of_body.end(), std::back_inserter(found));
  }
  // Both sides of a flat part are next to each other, and stay or go together.
  std::stable_sort(found.begin(), found.end(),
                   [](const Found& a, const Found& b) { return a.power > b.power; });
  if (found.size() > kMost) found.resize(found[kMost].pieces.empty() ? kMost - 1 : kMost);
  ShiningParts parts;
  std::vector<bool> is_compact(pieces.size(), false);
  for (const Found& one : found) {
    if (isCrowded(found, one, height_m)) continue;
    parts.compact.push_back(one.source);
    for (const std::uint32_t i : one.pieces) is_compact[i] = true;
  }
  for (std::size_t i = 0; i < pieces.size(); ++i)
    (is_compact[i] ? parts.of_compact : parts.others).push_back(pieces[i]);
  return parts;
}

}  // namespace sunlit::light
