#include "light/bake/gather/lamp_lit.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "light/bake/gather/lamp_sight.h"
#include "light/bake/samples/looked_for.h"
#include "light/geometry/corners.h"
#include "light/shading/reflectances.h"
#include "sunlit/quantity/angle.h"
#include "sunlit/quantity/random.h"

namespace sunlit::light {
namespace {

/// Parts are as long, at most, as a share of their distance to the lamp: of many lamps larger ones, so that
/// there are not too many.
constexpr float kPartLongest = 0.4f, kMostLongest = 2.0f, kManyLamps = 500.0f;
constexpr float kShortest_m = 0.02f, kShortestByShining_m = 0.05f;
/// A wall beside what shines would be many parts, and rays meet it well enough.
constexpr float kLargestByShining_m = 1.0f;
constexpr int kMostPartsHalved = 24;

const scene::Material& materialOf(const Geometry& geometry, std::uint32_t triangle) {
  return geometry.scene->materials[static_cast<std::size_t>(geometry.materials[triangle])];
}

/// Lamps by one of their coordinates.
class LampsAlong {
 public:
  explicit LampsAlong(const std::vector<LampBeam>& lamps) {
    for (const LampBeam& lamp : lamps) lamps_.push_back(&lamp);
    std::stable_sort(lamps_.begin(), lamps_.end(), [](const LampBeam* a, const LampBeam* b) {
      return a->position().x() < b->position().x();
    });
  }
  /// visit(lamp) all that are no farther from the box than kFarthestLit_m.
  template <typename Visit>
  void visitNear(const Eigen::AlignedBox3f& box, const Visit& visit) const {
    auto at = std::lower_bound(lamps_.begin(), lamps_.end(), box.min().x() - kFarthestLit_m,
                               [](const LampBeam* lamp, float x) { return lamp->position().x() < x; });
    for (; at != lamps_.end() && (*at)->position().x() <= box.max().x() + kFarthestLit_m; ++at)
      if (box.exteriorDistance((*at)->position()) < kFarthestLit_m) visit(**at);
  }

 private:
  std::vector<const LampBeam*> lamps_;
};

/// What one triangle passes on, part by part.
class LitTriangle {
 public:
  using Part = Reflectances::Part;

  LitTriangle(const BakeScene& scene, const Reflectances& reflectances)
      : scene_(scene), reflectances_(reflectances) {}

  void set(std::uint32_t triangle) {
    triangle_ = triangle;
    box_.setEmpty();
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = scene_.geometry.triangles[triangle][k];
      at_.col(static_cast<Eigen::Index>(k)) = scene_.geometry.positions[v];
      normals_.col(static_cast<Eigen::Index>(k)) = scene_.geometry.normals[v];
      box_.extend(scene_.geometry.positions[v]);
    }
  }
  const Eigen::AlignedBox3f& box() const { return box_; }
  Eigen::Vector3f face(int side) const { return sideNormal(scene_.geometry, triangle_, side); }
  bool isUsed(int side) const { return scene_.traits[triangle_].used[side]; }
  /// Which side looks at a point.
  int sideTowards(const Eigen::Vector3f& point) const {
    return face(0).dot(point - Eigen::Vector3f(at_.col(0))) > 0.0f ? 0 : 1;
  }
  /// The middle of a part.
  LitPoint middleOf(const Part& part, int side) const {
    const Eigen::Vector3f within = part.rowwise().mean();
    return {at_ * within, face(side), normals_ * within};
  }

  /// Visits parts whose longest edges are no longer than longest(box of the part), m, or none where that is
  /// 0.
  template <typename Longest, typename Visit>
  void divide(const Longest& longest, const Visit& visit) const {
    divide(Part::Identity(), 0, longest, visit);
  }

  /// A part that is lit.
  struct Lit {
    Part part;
    int side;
    Eigen::Array3f light;  ///< on that side, lx
    float lamp_m;
    float looked;  ///< share of it that is looked for
  };
  void add(const Lit& lit, std::vector<AreaLights::Piece>* pieces) const {
    const Reflectance mean = meanReflectance(reflectances_.mean({triangle_, lit.side == 0}, lit.part));
    const float transmission = materialOf(scene_.geometry, triangle_).transmission;
    const Eigen::Array3f through = transmission * mean.diffuse.min(mean.all());
    const Eigen::Array3f sent = lit.looked / kPiFloat * lit.light;
    AreaLights::Piece piece;
    for (std::size_t k = 0; k < 3; ++k) piece.corner[k] = at_ * lit.part.col(static_cast<Eigen::Index>(k));
    piece.normal = face(lit.side);
    piece.luminance = (mean.all() - through) * sent;
    piece.both = false;
    piece.lamp_m = lit.lamp_m;
    piece.looked = lit.looked;
    piece.triangle = triangle_;
    piece.side = static_cast<std::uint32_t>(lit.side);
    piece.within = lit.part.rowwise().mean();
    pieces->push_back(piece);
    if (!(transmission > 0.0f)) return;
    piece.normal = -piece.normal;
    piece.side = 1 - piece.side;
    piece.luminance = through * sent;
    pieces->push_back(piece);
  }

 private:
  template <typename Longest, typename Visit>
  void divide(const Part& part, int halved, const Longest& longest, const Visit& visit) const {
    const Eigen::Matrix3f corners = at_ * part;
    Eigen::AlignedBox3f box;
    float longest_m = 0.0f;
    Eigen::Index from = 0;
    for (Eigen::Index k = 0; k < 3; ++k) {
      box.extend(Eigen::Vector3f(corners.col(k)));
      const float edge_m = (corners.col((k + 1) % 3) - corners.col(k)).norm();
      if (edge_m > longest_m) longest_m = edge_m, from = k;
    }
    const float most_m = longest(box);
    if (!(most_m > 0.0f)) return;
    if (longest_m <= most_m || halved == kMostPartsHalved) return visit(part);
    const Eigen::Index to = (from + 1) % 3;
    const Eigen::Vector3f between = 0.5f * (part.col(from) + part.col(to));
    for (const Eigen::Index moved : {from, to}) {
      Part half = part;
      half.col(moved) = between;
      divide(half, halved + 1, longest, visit);
    }
  }

  const BakeScene& scene_;
  const Reflectances& reflectances_;
  std::uint32_t triangle_ = 0;
  Eigen::AlignedBox3f box_;
  Eigen::Matrix3f at_, normals_;  ///< of the triangle's corners
};

/// What triangles pass on of the light of lamps.
class LitByLamps {
 public:
  /// `longest`: of parts, in distances to the lamp.
  LitByLamps(const BakeScene& scene, const LampsAlong& lamps, float longest)
      : scene_(scene), lamps_(lamps), longest_(longest) {}

  void add(const LitTriangle& triangle, std::vector<AreaLights::Piece>* pieces) {
    lamps_.visitNear(triangle.box(), [&](const LampBeam& lamp) {
      const int side = triangle.sideTowards(lamp.position());
      if (!triangle.isUsed(side)) return;
      const auto longest = [&](const Eigen::AlignedBox3f& box) {
        const float away_m = box.exteriorDistance(lamp.position());
        if (away_m >= kFarthestLit_m || !(lamp.within(box).high > 0.0f)) return 0.0f;
        return std::max(longest_ * away_m, kShortest_m);
      };
      triangle.divide(longest, [&](const LitTriangle::Part& part) {
        aim(lamp, triangle.middleOf(part, side), {part, side, Eigen::Array3f::Zero(), 0.0f, 0.0f});
      });
      hidden_.assign(sights_.size(), 0);
      if (lamp.castsShadows()) scene_.rays.hide(sights_, &hidden_);
      for (std::size_t i = 0; i < lit_.size(); ++i)
        if (hidden_[i] == 0) triangle.add(lit_[i], pieces);
      sights_.clear();
      lit_.clear();
    });
  }

 private:
  void aim(const LampBeam& lamp, const LitPoint& point, LitTriangle::Lit lit) {
    lit.lamp_m = std::max((lamp.position() - point.position).norm(), 1e-3f);
    lit.looked = lookedFor(lit.lamp_m);
    if (!(lit.looked > 0.0f)) return;
    const std::optional<LampSight> sight = lampSight(lamp, point);
    if (!sight) return;
    lit.light = sight->light;
    sights_.push_back(sight->sight);
    lit_.push_back(lit);
  }

  const BakeScene& scene_;
  const LampsAlong& lamps_;
  const float longest_;
  std::vector<BakeSight> sights_;
  std::vector<LitTriangle::Lit> lit_;  ///< of each sight
  std::vector<std::uint8_t> hidden_;
};

/// What triangles pass on of the light of what shines.
class LitByShining {
 public:
  explicit LitByShining(const AreaLights& shining) : shining_(shining) {}

  void add(const LitTriangle& triangle, std::uint64_t key, std::vector<AreaLights::Piece>* pieces) const {
    const auto longest = [&](const Eigen::AlignedBox3f& box) {
      const float away_m = shining_.distance_m(box, kFarthestByShining_m);
      return away_m < kFarthestByShining_m ? std::max(kPartLongest * away_m, kShortestByShining_m) : 0.0f;
    };
    if (!(longest(triangle.box()) > 0.0f)) return;
    for (const int side : {0, 1}) {
      if (!triangle.isUsed(side)) continue;
      triangle.divide(longest, [&](const LitTriangle::Part& part) {
        const AreaLights::Light light = shining_.at(receiverAt(triangle.middleOf(part, side)), ++key);
        const float looked = lookedFor(light.distance_m, kFarthestByShining_m);
        if (looked > 0.0f)
          triangle.add({part, side, light.above + light.below, light.distance_m, looked}, pieces);
      });
    }
  }

 private:
  static Receiver receiverAt(const LitPoint& point) {
    Receiver receiver;
    receiver.origins.fill(point.position);
    receiver.lifts.fill(Receiver::clearance_m(point.position) * point.face);
    receiver.normal = point.shadingNormal();
    receiver.face = boundingFace(receiver.normal, point.face);
    return receiver;
  }

  const AreaLights& shining_;
};

/// Of triangles that may(scene, number) send light: by makeWork()(triangle, its number, pieces).
template <typename May, typename Work>
std::vector<AreaLights::Piece> piecesOf(const BakeScene& scene, const May& may, const Work& makeWork) {
  constexpr std::size_t kBlock = 512;  // triangles, of one task
  const Reflectances reflectances(scene.geometry);
  const std::size_t count = scene.geometry.triangles.size();
  std::vector<std::vector<AreaLights::Piece>> pieces((count + kBlock - 1) / kBlock);
  tbb::parallel_for(std::size_t{0}, pieces.size(), [&](std::size_t block) {
    auto work = makeWork();
    LitTriangle triangle(scene, reflectances);
    for (std::size_t t = block * kBlock; t < std::min(count, (block + 1) * kBlock); ++t) {
      if (!may(scene, static_cast<std::uint32_t>(t))) continue;
      triangle.set(static_cast<std::uint32_t>(t));
      work(triangle, t, &pieces[block]);
    }
  });
  std::vector<AreaLights::Piece> all;
  for (const std::vector<AreaLights::Piece>& some : pieces) all.insert(all.end(), some.begin(), some.end());
  return all;
}

}  // namespace

bool maySendLampLight(const BakeScene& scene, std::uint32_t triangle) {
  const scene::Material& material = materialOf(scene.geometry, triangle);
  return material.alpha_mode == scene::AlphaMode::kOpaque && !isGlass(material) &&
         !isLeaf(scene.traits[triangle].kind);
}

bool maySendShine(const BakeScene& scene, std::uint32_t triangle) {
  if (longestEdge(scene.geometry, triangle) > kLargestByShining_m) return false;
  return maySendLampLight(scene, triangle) && !glows(materialOf(scene.geometry, triangle), {});
}

std::vector<AreaLights::Piece> litPieces(const BakeScene& scene, const std::vector<LampBeam>& lamps) {
  if (lamps.empty()) return {};
  const LampsAlong along(lamps);
  const float more = std::sqrt(static_cast<float>(lamps.size()) / kManyLamps);
  const float longest = std::clamp(more * kPartLongest, kPartLongest, kMostLongest);
  return piecesOf(scene, maySendLampLight, [&] {
    return [work = LitByLamps(scene, along, longest)](const LitTriangle& triangle, std::uint64_t,
                                                      std::vector<AreaLights::Piece>* pieces) mutable {
      work.add(triangle, pieces);
    };
  });
}

std::vector<AreaLights::Piece> litPieces(const BakeScene& scene, const AreaLights& shining) {
  if (!shining.any()) return {};
  return piecesOf(scene, maySendShine, [&] {
    return [&](const LitTriangle& triangle, std::uint64_t number, std::vector<AreaLights::Piece>* pieces) {
      LitByShining(shining).add(triangle, scrambled(number), pieces);
    };
  });
}

}  // namespace sunlit::light
