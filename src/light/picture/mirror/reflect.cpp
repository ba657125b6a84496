#include "light/picture/mirror/reflections.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "light/geometry/ray_list.h"
#include "light/geometry/ray_start.h"
#include "light/picture/mirror/lobe_rays.h"
#include "light/picture/mirror/shining_in_lobes.h"
#include "light/picture/mirror/shining_list.h"
#include "light/shading/glass_sheets.h"
#include "light/shading/shading.h"
#include "light/shading/vertex.h"

namespace sunlit::light {
namespace {

/// Rays of one surface that meet triangles of one material, nearly in one plane, are one surface in its
/// mirror, too.
constexpr float kSamePlane = 0.985f, kSameDistance = 0.1f;

/// Sheets that light shines through, such as leaves, mirror by their lobe.
bool canMirror(const scene::Material& material) {
  return material.transmission == 0.0f;
}

/// Whether any surface may be smooth enough.
bool anyMirrors(const MirroredWorld& world, MirrorsByRays by_rays) {
  if (world.visibility.fixedGeometry().weathering) return true;
  const std::vector<scene::Material>& materials = world.scene.materials;
  return std::any_of(materials.begin(), materials.end(), [&](const scene::Material& material) {
    return canMirror(material) && (material.roughness < by_rays.none || material.roughness_map.given());
  });
}

/// Never into the surface.
Eigen::Vector3f clear(const Surface& surface, Eigen::Vector3f towards) {
  constexpr float kLeast = 1e-3f;
  const float lifted = surface.geometric_normal.dot(towards);
  if (lifted < kLeast) towards += (kLeast - lifted) * surface.geometric_normal;
  return towards.normalized();
}

class TileMirror {
 public:
  TileMirror(const Surfaces& surfaces, Onlooker onlooker, const MirroredWorld& world,
             const ShiningList& shining)
      : surfaces_(surfaces),
        shining_(shining),
        pixels_(lobePixels(surfaces)),
        onlooker_(onlooker),
        by_rays_(mirrorsByRays(world.visibility.fixedGeometry(), onlooker)),
        scene_(world.scene),
        visibility_(world.visibility),
        vertices_(visibility_.fixedGeometry(), visibility_.movingGeometry()),
        glass_(visibility_) {}

  void look(const Tile& tile, Reflections::TileReflections* found, Tile* seen) const {
    std::vector<Reflections::Mirroring>* const all = &found->surfaces;
    thread_local CastRays cast;
    thread_local std::vector<Hit> hits;
    cast.clear();
    for (std::uint32_t i = 0; i < tile.surfaces.size(); ++i) {
      const Surface& surface = tile.surfaces[i];
      if (!(surface.roughness < by_rays_.none)) continue;
      if (!canMirror(scene_.materials[static_cast<std::size_t>(surface.material)])) continue;
      Reflections::Mirroring mirroring;
      mirroring.surface = i;
      mirroring.by_rays = by_rays_.share(surface.roughness);
      mirroring.rays = lobeRays(surface, pixels_);
      all->push_back(mirroring);
      addRays(tile, mirroring, static_cast<std::uint32_t>(all->size() - 1), &cast);
    }
    if (all->empty()) return;
    hits.resize(cast.rays.size());
    visibility_.closest(cast.rays.rays(), hits.data(), Visibility::Blends::kLetPass);
    std::optional<ShiningInLobes> shining;
    if (shining_.any())
      shining.emplace(shining_, ShiningInLobes::Scene{visibility_, vertices_, glass_, pixels_.width}, tile,
                      *all);
    for (std::size_t begin = 0; begin < hits.size();) {
      Reflections::Mirroring& mirroring = (*all)[cast.rays.number()[begin]];
      sort({tile.surfaces[mirroring.surface], cast, hits, begin, begin + mirroring.rays,
            shining ? &*shining : nullptr},
           &mirroring, &found->open, seen);
      begin += mirroring.rays;
    }
    if (!shining) return;
    shining->add(
        all, [&](const Surface& surface, const Eigen::Vector3f& origin) { return toEye(surface, origin); });
  }

 private:
  /// Rays of several surfaces, and their LobeRay::weight.
  struct CastRays {
    RayList rays;
    std::vector<float> weights;
    void clear() {
      rays.clear();
      weights.clear();
    }
  };

  /// One surface's rays, and what they met.
  struct Looked {
    const Surface& surface;
    const CastRays& cast;
    const std::vector<Hit>& hits;
    std::size_t begin, end;
    const ShiningInLobes* shining;  ///< null: nothing shines

    Eigen::Vector3f origin(std::size_t i) const {
      const Rays all = cast.rays.rays();
      return {all.origin_x[i], all.origin_y[i], all.origin_z[i]};
    }
    Eigen::Vector3f towards(std::size_t i) const {
      const Rays all = cast.rays.rays();
      return {all.direction_x[i], all.direction_y[i], all.direction_z[i]};
    }
  };

  void addRays(const Tile& tile, const Reflections::Mirroring& mirroring, std::uint32_t number,
               CastRays* cast) const {
    const Surface& surface = tile.surfaces[mirroring.surface];
    cast->rays.reserve(mirroring.rays);
    for (std::uint32_t i = 0; i < mirroring.rays; ++i) {
      const std::size_t at = surface.first_sample + i;
      const Eigen::Vector3f origin = rayStart(tile, at);
      const LobeRay ray = lobeRay(surface, toEye(surface, origin), pixels_, i);
      cast->rays.add(number, origin, clear(surface, ray.towards));
      cast->weights.push_back(ray.weight);
    }
  }

  Eigen::Vector3f toEye(const Surface& surface, const Eigen::Vector3f& origin) const {
    return onlooker_ == Onlooker::kCamera ? Eigen::Vector3f((surfaces_.eye - origin).normalized())
                                          : surface.to_eye;
  }

  /// What one ray met.
  struct Met {
    Hit hit;
    Vertex vertex;
    Eigen::Array3f through;
    bool taken = false;

    bool alike(const Met& other) const {
      return vertex.material == other.vertex.material &&
             vertex.geometric_normal.dot(other.vertex.geometric_normal) > kSamePlane &&
             vertex.reflection.normal.dot(other.vertex.reflection.normal) > kSamePlane &&
             std::abs(hit.distance - other.hit.distance) < kSameDistance * hit.distance;
    }
  };

  void sort(const Looked& looked, Reflections::Mirroring* mirroring, std::vector<Reflections::Open>* open,
            Tile* seen) const {
    mirroring->first = static_cast<std::uint32_t>(seen->surfaces.size());
    mirroring->first_open = static_cast<std::uint32_t>(open->size());
    for (std::size_t i = looked.begin; i < looked.end; ++i) mirroring->weight += looked.cast.weights[i];
    if (!(mirroring->weight > 0.0f)) return;
    thread_local std::vector<Met> met;
    met.clear();
    for (std::size_t i = looked.begin; i < looked.end; ++i) {
      const float part = looked.cast.weights[i] / mirroring->weight;
      if (!(part > 0.0f)) continue;
      const Hit& hit = looked.hits[i];
      const Eigen::Array3f through = passLayers(looked, i, part, &met);
      if (hit.triangle == Hit::kMiss)
        open->push_back({looked.towards(i), through});
      else
        met.push_back({hit, vertexOf(looked, i), through});
    }
    for (std::size_t i = 0; i < met.size(); ++i) {
      if (!isGlass(*met[i].vertex.material))
        mirroring->nearest_m = std::min(mirroring->nearest_m, met[i].hit.distance);
      if (!met[i].taken) add(looked.surface, i, &met, seen);
    }
    if (!fillsLobe(looked.surface)) joinFrom(mirroring->first_open, open);
    mirroring->open_count = static_cast<std::uint32_t>(open->size()) - mirroring->first_open;
    mirroring->count = static_cast<std::uint32_t>(seen->surfaces.size()) - mirroring->first;
  }

  /// Where a ray ends, with as much of its own light as counts of that.
  Vertex vertexOf(const Looked& looked, std::size_t i) const {
    Vertex vertex = vertices_.at(looked.hits[i], looked.towards(i));
    if (looked.shining != nullptr && vertex.emission.maxCoeff() > 0.0f)
      vertex.emission *= looked.shining->countedOf(
          {looked.surface, toEye(looked.surface, looked.origin(i)), looked.towards(i)}, looked.hits[i]);
    return vertex;
  }

  /// Rays that hardly part look at one place of the sky.
  static void joinFrom(std::size_t first, std::vector<Reflections::Open>* open) {
    if (open->size() < first + 2) return;
    Reflections::Open joined{Eigen::Vector3f::Zero(), Eigen::Array3f::Zero()};
    for (std::size_t i = first; i < open->size(); ++i) {
      joined.towards += (*open)[i].towards;
      joined.share += (*open)[i].share;
    }
    joined.towards.normalize();
    open->resize(first);
    open->push_back(joined);
  }

  /// Adds what ray `i` is seen through, as by a camera, and returns what is left of it behind that: sheets of
  /// glass, which mirror as well, and what blends evenly, each of which takes its alpha of what is left.
  Eigen::Array3f passLayers(const Looked& looked, std::size_t i, float part, std::vector<Met>* met) const {
    Eigen::Array3f through = Eigen::Array3f::Constant(part);
    if (!glass_.anyVeils()) return through;
    thread_local std::vector<Hit> layers;
    const Hit& end = looked.hits[i];
    const Eigen::Vector3f towards = looked.towards(i);
    const float reach = end.triangle == Hit::kMiss ? std::numeric_limits<float>::infinity() : end.distance;
    glass_.layers({looked.origin(i), towards, 0.0f, reach}, &layers);
    for (const Hit& layer : layers) {
      const Vertex vertex = glass_.at(layer, towards);
      // What lies on a surface is hidden, as from that surface's own rays.
      const float above_m = (reach - layer.distance) * std::abs(vertex.geometric_normal.dot(towards));
      if (end.triangle != Hit::kMiss && above_m < rayClearance_m(vertex.front, reach)) continue;
      const bool glass = isGlass(*vertex.material);
      const float alpha = glass ? 1.0f : vertex.material->alpha;
      met->push_back({layer, vertex, alpha * through});
      through *=
          glass ? straightThrough(vertex.reflection) : Eigen::Array3f(Eigen::Array3f::Constant(1.0f - alpha));
    }
    return through;
  }

  /// What the rays from number `first` on met that is like what that one did.
  void add(const Surface& mirror, std::size_t first, std::vector<Met>* met, Tile* seen) const {
    const Vertex& vertex = (*met)[first].vertex;
    Surface surface;
    surface.geometric_normal = vertex.geometric_normal;
    surface.position = surface.to_eye = surface.shading_normal = Eigen::Vector3f::Zero();
    surface.albedo = surface.emission = surface.share = Eigen::Array3f::Zero();
    surface.roughness = surface.metalness = surface.film = 0.0f;
    surface.material = static_cast<std::int32_t>(vertex.material - scene_.materials.data());
    surface.pixel = mirror.pixel;
    surface.triangle = (*met)[first].hit.triangle;
    surface.first_sample = static_cast<std::uint32_t>(seen->origin_x.size());
    for (std::size_t i = first; i < met->size(); ++i) {
      Met& other = (*met)[i];
      if (other.taken || (i != first && !(*met)[first].alike(other))) continue;
      other.taken = true;
      ++surface.samples;
      const Reflection& reflection = other.vertex.reflection;
      surface.position += 0.5f * (other.vertex.front + other.vertex.behind);
      surface.to_eye += reflection.to_eye;
      surface.shading_normal += reflection.normal;
      surface.albedo += reflection.albedo;
      surface.emission += other.vertex.emission * other.through;
      surface.roughness += reflection.roughness;
      surface.metalness += reflection.metalness;
      surface.film += other.vertex.film;
      surface.share += other.through;
      seen->origin_x.push_back(other.vertex.front.x());
      seen->origin_y.push_back(other.vertex.front.y());
      seen->origin_z.push_back(other.vertex.front.z());
    }
    const float each = 1.0f / static_cast<float>(surface.samples);
    surface.position *= each;
    surface.to_eye.normalize();
    surface.shading_normal.normalize();
    surface.albedo *= each;
    // Of which as much may count as of no other: see ShiningInLobes.
    surface.emission = (surface.share > 0.0f).select(surface.emission / surface.share.max(1e-30f), 0.0f);
    surface.roughness *= each;
    surface.metalness *= each;
    surface.film *= each;
    surface.clearance_m = rayClearance_m(surface.position, 0.0f);
    seen->surfaces.push_back(surface);
  }

  const Surfaces& surfaces_;
  const ShiningList& shining_;
  LobePixels pixels_;
  Onlooker onlooker_;
  MirrorsByRays by_rays_;
  const scene::Scene& scene_;
  const Visibility& visibility_;
  SceneVertices vertices_;
  GlassSheets glass_;
};

void layOutLike(const Surfaces& surfaces, Surfaces* seen) {
  seen->width = surfaces.width;
  seen->height = surfaces.height;
  seen->samples_per_pixel = surfaces.samples_per_pixel;
  seen->pixel_origin = surfaces.pixel_origin;
  seen->pixel_right = surfaces.pixel_right;
  seen->pixel_down = surfaces.pixel_down;
  seen->bent = surfaces.bent;
  seen->map_from_optical = surfaces.map_from_optical;
  seen->eye = surfaces.eye;
  seen->tiles.resize(surfaces.tiles.size());
  for (std::size_t i = 0; i < surfaces.tiles.size(); ++i) {
    const Tile& tile = surfaces.tiles[i];
    Tile& other = seen->tiles[i];
    other.x = tile.x;
    other.y = tile.y;
    other.width = tile.width;
    other.height = tile.height;
  }
}

}  // namespace

Reflections reflect(const Surfaces& surfaces, Onlooker onlooker, const MirroredWorld& world, Surfaces* seen) {
  if (!anyMirrors(world, mirrorsByRays(world.visibility.fixedGeometry(), onlooker))) return {};
  Reflections made;
  made.tiles.resize(surfaces.tiles.size());
  layOutLike(surfaces, seen);
  const ShiningList shining(world.visibility.fixedGeometry());
  const TileMirror mirror(surfaces, onlooker, world, shining);
  tbb::parallel_for(std::size_t{0}, surfaces.tiles.size(),
                    [&](std::size_t i) { mirror.look(surfaces.tiles[i], &made.tiles[i], &seen->tiles[i]); });
  if (std::all_of(made.tiles.begin(), made.tiles.end(),
                  [](const auto& tile) { return tile.surfaces.empty(); }))
    return {};
  return made;
}

}  // namespace sunlit::light
