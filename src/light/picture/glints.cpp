#include "light/picture/glints.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "light/bake/samples/transport_data.h"
#include "light/geometry/ray_start.h"
#include "light/shading/polished_floor.h"

namespace sunlit::light {

std::unique_ptr<const Glints> Glints::of(const sky::DiscLight& disc, float least_lx, const Subject& subject) {
  if (!(disc.illuminance.value.maxCoeff() > least_lx)) return nullptr;
  const Outlooks& outlooks = subject.ready.outlooks;
  if (std::all_of(outlooks.begin(), outlooks.end(),
                  [](const TileOutlooks& tile) { return tile.without_glints.empty(); }))
    return nullptr;
  std::unique_ptr<Glints> glints(new Glints(disc, subject));
  glints->look();
  return glints;
}

Glints::Glints(const sky::DiscLight& disc, const Subject& subject)
    : subject_(subject),
      illuminance_(disc.illuminance.value),
      disc_towards_(disc.towards.vector().cast<float>()),
      disc_radius_rad_(static_cast<float>(disc.angular_radius.rad())),
      floor_(
          std::make_shared<const FloorMirror>(subject.visibility, disc_towards_, std::tan(disc_radius_rad_))),
      glass_(subject.visibility) {}

void Glints::look() {
  const float alpha = subject_.nodes.roughness * subject_.nodes.roughness;
  DiscVisibility::Seen disc{true,
                            FloorMirror::mirrored(disc_towards_),
                            disc_radius_rad_ + 2.0f * alpha,
                            DiscPoints::inFloor(disc_towards_, disc_radius_rad_, alpha),
                            floor_,
                            {}};
  for (const TileOutlooks& tile : subject_.ready.outlooks) {
    disc.wanted.emplace_back(tile.surfaces.size(), false);
    for (std::size_t i = 0; i < tile.without_glints.size(); ++i)
      disc.wanted.back()[i] = tile.without_glints[i] > 0.0f;
  }
  seen_ = std::make_unique<const DiscVisibility>(
      std::move(disc), DiscVisibility::Picture{subject_.ready.surfaces, subject_.ready.table});
}

Eigen::Array3f Glints::illuminance(std::size_t number, std::size_t index) const {
  const std::vector<float>& wanted = subject_.ready.outlooks[number].without_glints;
  if (wanted.empty()) return Eigen::Array3f::Zero();
  const float share = seen_->visibleShares(number)[index] * wanted[index];
  if (!(share > 0.0f)) return Eigen::Array3f::Zero();
  const Tile& tile = subject_.ready.surfaces.tiles[number];
  const Surface& surface = tile.surfaces[index];
  Eigen::Array3f mirrored = Eigen::Array3f::Constant(schlick(disc_towards_.z()) * (1.0f - kDielectricF0)) +
                            kDielectricF0;  // at an edge, none of its own rays may meet the floor
  for (std::uint32_t k = 0; k < surface.samples; ++k) {
    const Eigen::Vector3f origin = rayStart(tile, surface.first_sample + k, surface, towards());
    const std::optional<Vertex> floor = floor_->floorAlong(origin, towards());
    if (!floor) continue;
    mirrored = mirroredShare(*floor, disc_towards_.z());
    if (glass_.any()) {
      mirrored *= glass_.through({origin, towards(), 0.0f, (floor->front - origin).norm()}) *
                  glass_.through({floor->front, disc_towards_, 0.0f, std::numeric_limits<float>::infinity()});
    }
    break;
  }
  return share * mirrored * illuminance_;
}

}  // namespace sunlit::light
