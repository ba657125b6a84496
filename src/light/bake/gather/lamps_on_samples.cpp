#include "light/bake/gather/lamps_on_samples.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "light/bake/gather/lamp_lit.h"
#include "light/bake/gather/lamp_sight.h"
#include "light/bake/samples/looked_for.h"
#include "light/bake/samples/mesh_leaves.h"

namespace sunlit::light {
namespace {

/// Of what all lamps give: less is left out.
constexpr float kLeftOut = 0.01f;
/// So many, the brightest, are left out only for what others were found to give: walls may hide these.
constexpr std::size_t kNotLeftOut = 16;
/// lx of all that is left out beyond that: a tenth of what a moonless sky gives.
constexpr float kNextToNothing_lx = 1e-4f;
/// Points lie so far apart, at most, as a share of the distance to the lamp: its light, the cosine and 1 /
/// d², then changes by less than a tenth from one to the next.
constexpr float kSpacing = 0.3f;
constexpr int kMostAcross = 8;

/// Visits the middles of the across² equal triangles that a triangle falls into, by its own barycentric
/// coordinates.
template <typename Visit>
void visitMiddles(int across, const Visit& visit) {
  const float step = 1.0f / static_cast<float>(across);
  for (int i = 0; i < across; ++i) {
    for (int j = 0; i + j < across; ++j) {
      const Eigen::Vector2f at(static_cast<float>(i), static_cast<float>(j));
      const auto see = [&](float shift) {
        const Eigen::Vector2f uv = step * (at + Eigen::Vector2f::Constant(shift));
        visit(Eigen::Vector3f(1.0f - uv.sum(), uv.x(), uv.y()));
      };
      see(1.0f / 3.0f);
      if (i + j + 1 < across) see(2.0f / 3.0f);
    }
  }
}

/// Visits points, evenly spread, of the part of a leaf that is nearest to its corner k, by barycentric
/// coordinates of the leaf: the middle of that part, or 2 across² points.
template <typename Visit>
void visitPart(std::size_t k, int across, const Visit& visit) {
  const auto corner = static_cast<Eigen::Index>(k);
  if (across == 1) {
    Eigen::Vector3f middle = Eigen::Vector3f::Constant(7.0f / 36.0f);  // of the part's area
    middle[corner] = 22.0f / 36.0f;
    return visit(middle);
  }
  // Corner, middle of an edge, middle of the leaf; and the same by the other edge.
  const Eigen::Vector3f own = Eigen::Vector3f::Unit(corner), middle = Eigen::Vector3f::Constant(1.0f / 3.0f);
  for (Eigen::Index side = 1; side <= 2; ++side) {
    const Eigen::Vector3f edge = 0.5f * (own + Eigen::Vector3f::Unit((corner + side) % 3));
    visitMiddles(across, [&](const Eigen::Vector3f& b) { visit(b[0] * own + b[1] * edge + b[2] * middle); });
  }
}

/// Light of some places, lx m².
struct Sum {
  Eigen::Array3f direct = Eigen::Array3f::Zero(), looked_for = Eigen::Array3f::Zero();
  float lamp_m = 0.0f;  ///< times the sum of looked_for

  void add(const Eigen::Array3f& light, float lamp, bool may_send) {
    direct += light;
    if (!may_send) return;
    const Eigen::Array3f looked = lookedFor(lamp) * light;
    looked_for += looked;
    lamp_m += looked.sum() * lamp;
  }
  Sum& operator+=(const Sum& other) {
    direct += other.direct;
    looked_for += other.looked_for;
    lamp_m += other.lamp_m;
    return *this;
  }
};

/// What a triangle adds to a sample.
struct Arrival {
  std::uint32_t sample;
  Sum light;
};

class LampsOnTriangles {
 public:
  LampsOnTriangles(const BakeScene& scene, const SceneSamples& samples, const std::vector<LampBeam>& lamps)
      : scene_(scene), samples_(samples), lamps_(lamps) {}

  void light(std::uint32_t triangle, std::vector<Arrival>* arrivals) {
    const auto& roots = samples_.mesh.roots[triangle];
    if (!LightMesh::isCell(roots[0]) && !LightMesh::isCell(roots[1])) return;
    const auto& corners = scene_.geometry.triangles[triangle];
    Eigen::AlignedBox3f box;
    for (std::size_t k = 0; k < 3; ++k) {
      at_.col(static_cast<Eigen::Index>(k)) = scene_.geometry.positions[corners[k]];
      normals_.col(static_cast<Eigen::Index>(k)) = scene_.geometry.normals[corners[k]];
      box.extend(scene_.geometry.positions[corners[k]]);
    }
    all_.resize(lamps_.size());
    for (std::size_t i = 0; i < all_.size(); ++i) all_[i] = {0.0f, static_cast<std::uint32_t>(i)};
    choose(box, all_, &of_triangle_);
    if (of_triangle_.empty()) return;
    may_send_ = maySendLampLight(scene_, triangle);
    whole_m2_ = 0.5f * (at_.col(1) - at_.col(0)).cross(at_.col(2) - at_.col(0)).norm();
    for (int side = 0; side < 2; ++side) {
      const std::uint32_t root = roots[static_cast<std::size_t>(side)];
      if (!LightMesh::isCell(root)) continue;
      face_ = sideNormal(scene_.geometry, triangle, side);
      visitLeaves(samples_.mesh, root, Eigen::Matrix3f::Identity(),
                  [&](const LightMesh::Cell& cell, const Eigen::Matrix3f& within) {
                    lightLeaf(cell, within, arrivals);
                  });
    }
  }

 private:
  /// A lamp and what it gives at most, lx.
  using AtMost = std::pair<float, std::uint32_t>;

  /// Those of `from` that may matter somewhere in `box`, the brightest first.
  void choose(const Eigen::AlignedBox3f& box, const std::vector<AtMost>& from, std::vector<AtMost>* chosen) {
    chosen->clear();
    float unhidden = 0.0f, left_out = 0.0f;
    for (const auto& [any, lamp] : from) {
      const LampBeam::Bounds bounds = lamps_[lamp].within(box);
      unhidden += bounds.low;
      if (bounds.high > 0.0f) chosen->emplace_back(bounds.high, lamp);
    }
    std::sort(chosen->begin(), chosen->end(), std::greater<>());
    while (!chosen->empty()) {
      left_out += chosen->back().first;
      const float little = chosen->size() > kNotLeftOut ? kLeftOut * unhidden : 0.0f;
      if (left_out > std::max(little, kNextToNothing_lx)) break;
      chosen->pop_back();
    }
  }

  void lightLeaf(const LightMesh::Cell& cell, const Eigen::Matrix3f& within, std::vector<Arrival>* arrivals) {
    const Eigen::Matrix3f corners = at_ * within;
    Eigen::AlignedBox3f box;
    for (Eigen::Index k = 0; k < 3; ++k) box.extend(Eigen::Vector3f(corners.col(k)));
    choose(box, of_triangle_, &of_leaf_);
    if (of_leaf_.empty()) return;
    const float part_m2 = whole_m2_ * std::abs(within.determinant()) / 3.0f;
    std::array<Sum, 3> sums;
    float left = 0.0f, found = 0.0f;  // lx: of lamps to come, at most; where least has arrived
    for (const AtMost& one : of_leaf_) left += one.first;
    for (const AtMost& one : of_leaf_) {
      if (left < kLeftOut * found) break;
      left -= one.first;
      const std::uint32_t lamp = one.second;
      const float away = std::max(box.exteriorDistance(lamps_[lamp].position()), lamps_[lamp].radius_m());
      const float longest = box.diagonal().norm();
      // Of each corner's part, half as wide as the leaf.
      const int across = std::clamp(
          static_cast<int>(std::ceil(0.5f * longest / std::max(kSpacing * away, 1e-3f))), 1, kMostAcross);
      for (std::size_t k = 0; k < 3; ++k) {
        float points = 0.0f;
        const float through = samples_.receivers[samples_.nearest_sample[cell.corner[k]]].transmission;
        visitPart(k, across, [&](const Eigen::Vector3f& b) {
          aim({lamp, within * b, through});
          points += 1.0f;
        });
        weights_.push_back(part_m2 / points);
        ends_.push_back(sights_.size());
      }
      cast(lamps_[lamp].castsShadows(), &sums);
      found = std::min({sums[0].direct.maxCoeff(), sums[1].direct.maxCoeff(), sums[2].direct.maxCoeff()}) /
              part_m2;
    }
    for (std::size_t k = 0; k < 3; ++k)
      if (sums[k].direct.maxCoeff() > 0.0f)
        arrivals->push_back({samples_.nearest_sample[cell.corner[k]], sums[k]});
  }

  struct Aim {
    std::uint32_t lamp;
    const Eigen::Vector3f& within;
    float through;  ///< Receiver::transmission of the sample that it is for
  };
  /// Adds a ray from a point of the triangle to the lamp, unless it turns away.
  void aim(const Aim& aim) {
    const LampBeam& lamp = lamps_[aim.lamp];
    const Eigen::Vector3f point = at_ * aim.within;
    const std::optional<LampSight> sight =
        lampSight(lamp, {point, face_, normals_ * aim.within, aim.through});
    if (!sight) return;
    const float lamp_m = std::max((lamp.position() - point).norm(), 1e-3f);
    sights_.push_back(sight->sight);
    light_.push_back({sight->light, lamp_m});
  }

  struct Light {
    Eigen::Array3f light;  ///< lx
    float lamp_m;
  };
  /// Casts the rays that were aimed, and adds what arrives.
  void cast(bool shadows, std::array<Sum, 3>* sums) {
    hidden_.assign(sights_.size(), 0);
    if (shadows) scene_.rays.hide(sights_, &hidden_);
    std::size_t corner = 0;
    for (std::size_t i = 0; i < sights_.size(); ++i) {
      while (i >= ends_[corner]) ++corner;
      if (!hidden_[i]) (*sums)[corner].add(weights_[corner] * light_[i].light, light_[i].lamp_m, may_send_);
    }
    sights_.clear();
    light_.clear();
    weights_.clear();
    ends_.clear();
  }

  const BakeScene& scene_;
  const SceneSamples& samples_;
  const std::vector<LampBeam>& lamps_;
  Eigen::Matrix3f at_, normals_;  ///< of the triangle's corners
  Eigen::Vector3f face_;          ///< of the side that is lit
  float whole_m2_ = 0.0f;
  bool may_send_ = false;  ///< see maySendLampLight()
  std::vector<AtMost> all_, of_triangle_, of_leaf_;
  std::vector<BakeSight> sights_;
  std::vector<Light> light_;  ///< of each sight if nothing hides the lamp
  std::vector<std::uint8_t> hidden_;
  std::vector<float> weights_;     ///< of each corner's points
  std::vector<std::size_t> ends_;  ///< of each corner's rays
};

}  // namespace

StraightLight lampsOnSamples(const BakeScene& scene, const SceneSamples& samples,
                             const std::vector<LampBeam>& lamps) {
  constexpr std::size_t kBlock = 512;  // triangles, of one task
  const std::size_t count = samples.mesh.roots.size();
  std::vector<std::vector<Arrival>> arrivals((count + kBlock - 1) / kBlock);
  tbb::parallel_for(std::size_t{0}, arrivals.size(), [&](std::size_t block) {
    LampsOnTriangles work(scene, samples, lamps);
    for (std::size_t t = block * kBlock; t < std::min(count, (block + 1) * kBlock); ++t)
      work.light(static_cast<std::uint32_t>(t), &arrivals[block]);
  });
  std::vector<Sum> sums(samples.receivers.size());
  for (const std::vector<Arrival>& block : arrivals)
    for (const Arrival& arrival : block) sums[arrival.sample] += arrival.light;
  StraightLight result(sums.size());
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const float area_m2 = samples.areas_m2[i] > 0.0f ? samples.areas_m2[i] : 1.0f;
    result.direct[i] = sums[i].direct / area_m2;
    result.looked_for[i] = sums[i].looked_for / area_m2;
    const float weight = sums[i].looked_for.sum();
    if (weight > 0.0f) result.lamp_m[i] = sums[i].lamp_m / weight;
  }
  return result;
}

}  // namespace sunlit::light
