#include "light/picture/glints.h"

#include <tbb/parallel_for.h>

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
  std::unique_ptr<Glints> glints(new Glints(disc, subject));
  if (!glints->findWanted()) return nullptr;
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
      glass_(subject.visibility),
      shares_(subject.ready.surfaces.tiles.size()) {}

bool Glints::findWanted() {
  std::vector<char> any(shares_.size(), 0);
  tbb::parallel_for(std::size_t{0}, shares_.size(), [&](std::size_t t) {
    const std::vector<Outlook>& outlooks = subject_.ready.outlooks[t].surfaces;
    shares_[t].assign(outlooks.size(), 0.0f);
    for (std::size_t i = 0; i < outlooks.size(); ++i) {
      shares_[t][i] = subject_.nodes.at(outlooks[i].light);
      if (shares_[t][i] > 0.0f) any[t] = 1;
    }
  });
  return std::find(any.begin(), any.end(), 1) != any.end();
}

void Glints::look() {
  const float alpha = subject_.nodes.roughness * subject_.nodes.roughness;
  DiscVisibility::Seen disc{true,
                            FloorMirror::mirrored(disc_towards_),
                            disc_radius_rad_ + 2.0f * alpha,
                            DiscPoints::inFloor(disc_towards_, disc_radius_rad_, alpha),
                            floor_,
                            {}};
  for (const std::vector<float>& of_tile : shares_) {
    disc.wanted.emplace_back();
    for (const float share : of_tile) disc.wanted.back().push_back(share > 0.0f);
  }
  seen_ = std::make_unique<const DiscVisibility>(
      std::move(disc), DiscVisibility::Picture{subject_.ready.surfaces, subject_.ready.table});
}

Eigen::Array3f Glints::illuminance(std::size_t number, std::size_t index) const {
  const float share = seen_->visibleShares(number)[index] * shares_[number][index];
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
