#include "light/bake/samples/compact_shapes.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "light/patches/even_directions.h"
#include "sunlit/quantity/angle.h"
#include "sunlit/quantity/photometry.h"

namespace sunlit::light {
namespace {

using Piece = AreaLights::Piece;

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

/// Calls `add` with places of a piece and how much each counts in the mean square of all of its places: its
/// corners a twelfth, its middle three quarters.
template <typename Add>
void eachOfMeanSquare(const Piece& piece, const Add& add) {
  for (const Eigen::Vector3f& corner : piece.corner) add(corner, 1.0 / 12.0);
  add(piece.middle(), 0.75);
}

const std::vector<Eigen::Vector3f>& sidesOfBodies() {
  static const std::vector<Eigen::Vector3f> directions = evenDirections(kDirections);
  return directions;
}

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
std::optional<CompactShape> asBody(const std::vector<Piece>& pieces, const std::vector<std::uint32_t>& list,
                                   const Sums& sums) {
  const std::vector<Eigen::Vector3f>& directions = sidesOfBodies();
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
  CompactShape found;
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

/// The straight line along which a body is longest.
struct Line {
  Eigen::Vector3f axis;  ///< unit
  float half_m, radius_m;
  float spread;  ///< mean square of places along it, of that of an even line as long
};

Line lineOf(const std::vector<Piece>& pieces, const std::vector<std::uint32_t>& list, const Sums& sums) {
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (const std::uint32_t i : list) {
    const auto add = [&](const Eigen::Vector3f& at, double share) {
      const Eigen::Vector3d away = (at - sums.middle).cast<double>();
      squares += share * static_cast<double>(pieces[i].power()) * away * away.transpose();
    };
    eachOfMeanSquare(pieces[i], add);
  }
  squares /= static_cast<double>(sums.power);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(squares);
  Line line{axes.eigenvectors().col(2).cast<float>(), 0.0f, 0.0f, 0.0f};
  for (const std::uint32_t i : list) {
    for (const Eigen::Vector3f& corner : pieces[i].corner) {
      const Eigen::Vector3f away = corner - sums.middle;
      const float along_m = line.axis.dot(away);
      line.half_m = std::max(line.half_m, std::abs(along_m));
      line.radius_m = std::max(line.radius_m, (away - along_m * line.axis).norm());
    }
  }
  line.spread = 3.0f * static_cast<float>(axes.eigenvalues()[2]) / (line.half_m * line.half_m);
  return line;
}

/// As a line that gives by the sine of the angle to it.
std::optional<CompactShape> asTube(const std::vector<Piece>& pieces, const std::vector<std::uint32_t>& list,
                                   const Sums& sums) {
  constexpr float kLeastAspect = 4.0f, kUnevenSpread = 0.15f;
  constexpr float kSide = 0.7f;  // of the sine: there a tube's light is told by its sides
  constexpr float kEnds = 0.2f;  // of its intensity: what its ends may give
  const Line line = lineOf(pieces, list, sums);
  if (!(line.half_m > kLeastAspect * line.radius_m) || std::abs(line.spread - 1.0f) > kUnevenSpread)
    return std::nullopt;
  const std::vector<Eigen::Vector3f>& directions = sidesOfBodies();
  const auto intensity = intensitiesOf(pieces, list, sums, directions);
  if (!intensity) return std::nullopt;
  const auto sine = [&](std::size_t k) { return line.axis.cross(directions[k]).norm(); };
  float sum = 0.0f, sines = 0.0f;
  for (std::size_t k = 0; k < directions.size(); ++k) {
    if (sine(k) < kSide) continue;
    sum += (*intensity)[static_cast<Eigen::Index>(k)];
    sines += sine(k);
  }
  const float brightest = sum / sines;
  for (std::size_t k = 0; k < directions.size(); ++k) {
    const float off = std::abs((*intensity)[static_cast<Eigen::Index>(k)] - brightest * sine(k));
    if (off > (sine(k) < kSide ? kEnds : kAlike) * brightest) return std::nullopt;
  }
  CompactShape found;
  found.source = {sums.middle,
                  sums.intensity * (brightest / sums.power),
                  Eigen::Vector3f::Zero(),
                  Eigen::Matrix3f::Identity(),
                  Eigen::Matrix<float, 3, 2>::Zero(),
                  false,
                  std::sqrt(4.0f * line.half_m * line.radius_m / kPiFloat),
                  sums.reach_m,
                  line.radius_m};
  found.source.half.col(0) = line.half_m * line.axis;
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
    eachOfMeanSquare(piece, [&](const Eigen::Vector3f& at, double share) {
      const Eigen::Array2d away = (sides.transpose() * (at - sums.middle)).cast<double>();
      squares += share * static_cast<double>(piece.power()) * away.square();
    });
    for (const Eigen::Vector3f& corner : piece.corner)
      uneven_m = std::max(uneven_m, std::abs(normal.dot(corner - sums.middle)));
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
std::vector<CompactShape> asFaces(const std::vector<Piece>& pieces, std::vector<std::uint32_t> list,
                                  const Sums& body) {
  constexpr std::size_t kMostFaces = 6;
  std::vector<CompactShape> found;
  float left = body.power;
  for (std::size_t face = 0; face < kMostFaces && left > kFaint * body.power; ++face) {
    CompactShape one;
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

}  // namespace

std::vector<CompactShape> compactShapes(const std::vector<Piece>& pieces,
                                        const std::vector<std::uint32_t>& body, float largest_m) {
  const Sums sums(pieces, body);
  if (!(sums.power > 0.0f) || sums.reach_m > largest_m) return {};
  if (std::optional<CompactShape> whole = asBody(pieces, body, sums)) return {std::move(*whole)};
  if (std::optional<CompactShape> whole = asTube(pieces, body, sums)) return {std::move(*whole)};
  return asFaces(pieces, body, sums);
}

}  // namespace sunlit::light
