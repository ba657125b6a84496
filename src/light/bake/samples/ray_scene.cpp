#include "light/bake/samples/ray_scene.h"

#include <tbb/parallel_for.h>

#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "light/bake/samples/bake_veils.h"
#include "light/bake/samples/embree_packet.h"
#include "light/bake/samples/masked_group.h"
#include "light/bake/samples/triangle_kinds.h"
#include "light/geometry/cutout.h"
#include "light/geometry/embree.h"
#include "light/geometry/embree_fault.h"
#include "light/geometry/triangle_mesh.h"

namespace sunlit::light {
namespace {

enum GeometryNumber : unsigned { kOpaque = 0, kMasked = 1, kLeaves = 2 };

/// Lets a ray pass where the surface is cut out.
void passCutoutsOfBake(const RTCFilterFunctionNArguments* at) {
  eachMasked(*at, [at](const Cutouts::Query& surface, unsigned i) {
    if (!surface.solid(RTCHitN_u(at->hit, at->N, i), RTCHitN_v(at->hit, at->N, i))) at->valid[i] = 0;
  });
}

/// A query for what is seen from one side.
struct FacingQuery {
  RayContext context;  ///< first, so that its address is that of the whole
  const Geometry* geometry;
  const std::vector<std::uint32_t>* triangles;  ///< as RayScene::Embree has them
  RayScene::Facing facing;
};

/// Lets a ray pass leaves and what faces the other way.
void passOthers(const RTCFilterFunctionNArguments* arguments) {
  const auto& query = *reinterpret_cast<const FacingQuery*>(arguments->context);
  for (unsigned i = 0; i < arguments->N; ++i) {
    if (arguments->valid[i] != -1) continue;
    const Eigen::Vector3f way(RTCRayN_dir_x(arguments->ray, arguments->N, i),
                              RTCRayN_dir_y(arguments->ray, arguments->N, i),
                              RTCRayN_dir_z(arguments->ray, arguments->N, i));
    const unsigned number = RTCHitN_geomID(arguments->hit, arguments->N, i);
    const std::uint32_t met = query.triangles[number][RTCHitN_primID(arguments->hit, arguments->N, i)];
    const float along = query.geometry->planes[met].normal.dot(way);
    const bool wanted = query.facing == RayScene::Facing::kAway ? along > 0.0f : along < 0.0f;
    if (number == kLeaves || !wanted) arguments->valid[i] = 0;
  }
}

/// Part of a leaf card, by its corners' barycentric (u, v) in the card's triangle.
struct LeafPart {
  std::array<Eigen::Vector2f, 3> corner;

  Eigen::Vector2f at(float u, float v) const {
    return (1.0f - u - v) * corner[0] + u * corner[1] + v * corner[2];
  }
  Eigen::Vector2f middle() const { return (corner[0] + corner[1] + corner[2]) / 3.0f; }
};

using LeafParts = std::vector<LeafPart>;

/// The whole, or quarters.
LeafParts partsOf(TriangleKind kind) {
  const Eigen::Vector2f a(0.0f, 0.0f), b(1.0f, 0.0f), c(0.0f, 1.0f);
  if (kind != TriangleKind::kSpray) return {{{a, b, c}}};
  const Eigen::Vector2f ab(0.5f, 0.0f), bc(0.5f, 0.5f), ca(0.0f, 0.5f);
  return {{{a, ab, ca}}, {{ab, b, bc}}, {{ca, bc, c}}, {{ab, bc, ca}}};
}

/// Share of a part of a masked triangle that is solid.
float coverage(const Cutouts& cutouts, std::uint32_t masked, const LeafPart& part) {
  constexpr int kAcross = 8;
  int solid = 0, all = 0;
  for (int i = 0; i < kAcross; ++i) {
    for (int j = 0; i + j < kAcross; ++j) {
      const Eigen::Vector2f at =
          part.at((static_cast<float>(i) + 0.33f) / kAcross, (static_cast<float>(j) + 0.33f) / kAcross);
      ++all;
      if (cutouts.solid(masked, at.x(), at.y())) ++solid;
    }
  }
  return static_cast<float>(solid) / static_cast<float>(all);
}

/// What is solid of a card, each part shrunk about its middle to the area that its mask leaves.
LeafParts solidParts(const Cutouts& cutouts, std::uint32_t masked, TriangleKind kind) {
  LeafParts solid;
  for (LeafPart part : partsOf(kind)) {
    const float scale = std::sqrt(coverage(cutouts, masked, part));
    if (scale <= 0.0f) continue;
    const Eigen::Vector2f middle = part.middle();
    for (Eigen::Vector2f& corner : part.corner) corner = middle + scale * (corner - middle);
    solid.push_back(part);
  }
  return solid;
}

}  // namespace

struct RayScene::Embree {
  explicit Embree(std::shared_ptr<const Geometry> geometry_to_use)
      : geometry(std::move(geometry_to_use)), cutouts(*geometry), device(newDevice()) {
    scene.reset(rtcNewScene(device.get()));
    rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_HIGH);
    rtcSetSceneFlags(scene.get(), kFilterOfQuery);
    sortTriangles();
    attachWhole(kOpaque);
    attachWhole(kMasked);
    attachLeaves();
    rtcCommitScene(scene.get());
    requireFine(device.get(), treeOf(geometry->triangles.size()));
  }

  void sortTriangles() {
    triangles[kOpaque] = cutouts.opaqueTriangles();
    masked_group.cutouts = &cutouts;
    MaskedGroup veil_group{&cutouts, {}};
    const std::vector<std::uint32_t>& masked = cutouts.maskedTriangles();
    for (std::uint32_t i = 0; i < masked.size(); ++i) {
      if (isLeaf(triangleKind(*geometry, masked[i]))) {
        leaves.push_back(i);
      } else if (Cutouts::Query(cutouts, i).blends()) {
        veil_group.masked.push_back(i);
      } else {
        triangles[kMasked].push_back(masked[i]);
        masked_group.masked.push_back(i);
      }
    }
    if (!veil_group.masked.empty()) veils.emplace(*geometry, std::move(veil_group), device.get());
  }

  void attachWhole(GeometryNumber number) {
    const std::vector<std::uint32_t>& chosen = triangles[number];
    if (chosen.empty()) return;
    const RTCGeometry mesh = triangleMesh(device.get(), *geometry, chosen);
    if (number == kMasked) {
      rtcSetGeometryUserData(mesh, &masked_group);
      rtcSetGeometryIntersectFilterFunction(mesh, passCutoutsOfBake);
      rtcSetGeometryOccludedFilterFunction(mesh, passCutoutsOfBake);
    }
    attach(mesh, scene.get(), number);
  }

  /// A leaf card becomes smaller, solid triangles of as much area as its mask leaves: the same light gets
  /// through a crown, without a look at the mask for every leaf on a ray's way.
  void attachLeaves() {
    std::vector<LeafParts> solid(leaves.size());
    tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t i) {
      const TriangleKind kind = triangleKind(*geometry, cutouts.maskedTriangles()[leaves[i]]);
      solid[i] = solidParts(cutouts, leaves[i], kind);
    });
    for (std::size_t i = 0; i < leaves.size(); ++i) {
      leaf_parts.insert(leaf_parts.end(), solid[i].begin(), solid[i].end());
      triangles[kLeaves].resize(leaf_parts.size(), cutouts.maskedTriangles()[leaves[i]]);
    }
    if (leaf_parts.empty()) return;
    const TriangleMesh mesh = newTriangleMesh(device.get(), 3 * leaf_parts.size(), leaf_parts.size());
    for (std::size_t i = 0; i < leaf_parts.size(); ++i) {
      const auto& card = geometry->triangles[triangles[kLeaves][i]];
      for (std::size_t k = 0; k < 3; ++k) {
        const Eigen::Vector2f& uv = leaf_parts[i].corner[k];
        mesh.vertices[3 * i + k] = (1.0f - uv.x() - uv.y()) * geometry->positions[card[0]] +
                                   uv.x() * geometry->positions[card[1]] +
                                   uv.y() * geometry->positions[card[2]];
        mesh.triangles[i][k] = static_cast<std::uint32_t>(3 * i + k);
      }
    }
    attach(mesh.handle, scene.get(), kLeaves);
  }

  /// What the rays of `packet` met.
  void read(const RTCRayHit16& packet, const RayPacket& rays, HitPacket* hits) const {
    for (int i = 0; i < RayPacket::kSize; ++i) {
      const unsigned number = packet.hit.geomID[i];
      if (!rays.valid[i] || number == RTC_INVALID_GEOMETRY_ID) {
        hits->triangle[i] = HitPacket::kNothing;
        continue;
      }
      const unsigned primitive = packet.hit.primID[i];
      hits->triangle[i] = triangles[number][primitive];
      Eigen::Vector2f uv(packet.hit.u[i], packet.hit.v[i]);
      if (number == kLeaves) uv = leaf_parts[primitive].at(uv.x(), uv.y());
      hits->u[i] = uv.x();
      hits->v[i] = uv.y();
      hits->distance[i] = packet.ray.tfar[i];
    }
  }

  std::shared_ptr<const Geometry> geometry;
  Cutouts cutouts;
  MaskedGroup masked_group;
  std::vector<std::uint32_t> leaves;        ///< index into Cutouts::maskedTriangles()
  LeafParts leaf_parts;                     ///< those attached, by Embree's number
  std::vector<std::uint32_t> triangles[3];  ///< index into Geometry::triangles, by Embree's numbers
  DevicePointer device;
  ScenePointer scene;
  std::optional<BakeVeils> veils;  ///< empty: none
};

RayScene::RayScene(std::shared_ptr<const Geometry> geometry)
    : embree_(std::make_unique<Embree>(std::move(geometry))) {}
RayScene::~RayScene() = default;

const Geometry& RayScene::geometry() const {
  return *embree_->geometry;
}

void RayScene::cast(const RayPacket& rays, HitPacket* hits) const {
  alignas(64) RTCRayHit16 packet = packetOf(rays, RayReach());
  // Rays of one direction from places metres apart soon part among leaves.
  intersect<kIncoherent>(rays.valid, embree_->scene.get(), &packet);
  embree_->read(packet, rays, hits);
}

void RayScene::addVeils(const RayPacket& rays, HitLayers* layers) const {
  layers->veils.clear();
  if (embree_->veils) embree_->veils->add(rays, layers);
}

void RayScene::hide(const RayPacket& rays, const RayReach& reach, std::uint8_t* hidden) const {
  alignas(64) RTCRay16 packet = packetOf(rays, reach).ray;
  occluded<kIncoherent>(rays.valid, embree_->scene.get(), &packet);
  if (embree_->veils) embree_->veils->stop(rays.valid, &packet);
  // Of what is hidden, Embree sets the end to −∞.
  for (int i = 0; i < RayPacket::kSize; ++i) hidden[i] = packet.tfar[i] < 0.0f ? 1 : 0;
}

void RayScene::castAmong(Facing facing, const RayPacket& rays, const RayReach& reach, HitPacket* hits) const {
  alignas(64) RTCRayHit16 packet = packetOf(rays, reach);
  FacingQuery query;
  begin(&query.context);
  query.geometry = embree_->geometry.get();
  query.triangles = embree_->triangles;
  query.facing = facing;
  intersect(rays.valid, embree_->scene.get(), {passOthers, &query.context}, &packet);
  embree_->read(packet, rays, hits);
}

}  // namespace sunlit::light
