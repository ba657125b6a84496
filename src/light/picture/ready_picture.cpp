#include "light/picture/ready_picture.h"

#include <tbb/parallel_for.h>

#include <array>
#include <optional>
#include <utility>

#include "light/bake/samples/transport_data.h"
#include "light/geometry/corners.h"
#include "light/picture/mirror/find_mirrors.h"
#include "sunlit/light/transport.h"

namespace sunlit::light {
namespace {

/// Asks memory for what findPlaces() will look up of surfaces further on: each lies elsewhere.
class LookAhead {
 public:
  LookAhead(const Geometry& geometry, const TransportData& data, const std::vector<Surface>& surfaces)
      : geometry_(geometry), data_(data), surfaces_(surfaces) {}

  void from(std::size_t i) const {
    constexpr std::size_t kNear = 8, kFar = 16;
    if (i + kFar < surfaces_.size() && known(i + kFar)) {
      const std::uint32_t triangle = surfaces_[i + kFar].triangle;
      __builtin_prefetch(&geometry_.triangles[triangle]);
      __builtin_prefetch(&geometry_.planes[triangle]);
      __builtin_prefetch(&data_.mesh.roots[triangle]);
      if (!data_.leaves.first.empty()) __builtin_prefetch(&data_.leaves.first[triangle]);
    }
    if (i + kNear < surfaces_.size() && known(i + kNear)) {
      const std::uint32_t triangle = surfaces_[i + kNear].triangle;
      for (const std::uint32_t corner : geometry_.triangles[triangle])
        __builtin_prefetch(&geometry_.positions[corner]);
      for (const std::uint32_t root : data_.mesh.roots[triangle])
        if (LightMesh::isCell(root)) __builtin_prefetch(&data_.mesh.cells[root]);
      if (data_.leaves.known(triangle)) __builtin_prefetch(&data_.leaves.grids[data_.leaves.first[triangle]]);
    }
  }

 private:
  bool known(std::size_t i) const { return surfaces_[i].triangle < geometry_.triangles.size(); }

  const Geometry& geometry_;
  const TransportData& data_;
  const std::vector<Surface>& surfaces_;
};

/// Sets Outlook::light and TileOutlooks::sheets of surfaces of the scene that was baked.
void findPlaces(const Geometry& geometry, const TransportData& data, const Tile& tile,
                TileOutlooks* outlooks) {
  const std::vector<scene::Material>& materials = geometry.scene->materials;
  std::uint32_t last = 0xffffffffu;  // neighbours often lie on one triangle
  std::optional<Corners> corners;
  const LookAhead ahead(geometry, data, tile.surfaces);
  for (std::size_t i = 0; i < tile.surfaces.size(); ++i) {
    ahead.from(i);
    const Surface& surface = tile.surfaces[i];
    const std::uint32_t triangle = surface.triangle;
    if (triangle >= geometry.triangles.size()) continue;  // a body that moves: see BodyLight
    Outlook& outlook = outlooks->surfaces[i];
    const bool front = geometry.planes[triangle].normal.dot(surface.geometric_normal) > 0.0f;
    if (triangle != last) corners.emplace(geometry, last = triangle);
    const std::array<float, 3> within = corners->within(surface.position);
    outlook.light = lightPlace(data.mesh, {triangle, front}, within);
    const bool thin = materials[static_cast<std::size_t>(surface.material)].transmission > 0.0f;
    const bool leaf = data.leaves.known(triangle);
    if (!thin && !leaf) continue;
    outlook.sheet = static_cast<std::uint32_t>(outlooks->sheets.size());
    SheetOutlook& sheet = outlooks->sheets.emplace_back();
    if (thin) sheet.behind = lightPlace(data.mesh, {triangle, !front}, within);
    if (leaf) sheet.sky = data.leaves.at(triangle, within);
  }
}

void findGlints(const GlintNodes& nodes, TileOutlooks* outlooks) {
  const std::size_t count = outlooks->surfaces.size();
  for (std::size_t i = 0; i < count; ++i) {
    const float share = nodes.at(outlooks->surfaces[i].light);
    if (!(share > 0.0f)) continue;
    if (outlooks->without_glints.empty()) outlooks->without_glints.assign(count, 0.0f);
    outlooks->without_glints[i] = share;
  }
}

void findBaked(const Surfaces& surfaces, const OutlookSources& sources, Outlooks* outlooks) {
  const Geometry& geometry = *sources.world.geometry;
  const TransportData& data = sources.world.transport->data();
  const GlintNodes* const glints = sources.world.transport->glintNodes().get();
  const auto findMirrorsOf = [&](std::size_t i) {
    findMirrors(data, {*geometry.scene, surfaces.width, surfaces.tiles[i]}, &(*outlooks)[i]);
  };
  tbb::parallel_for(std::size_t{0}, surfaces.tiles.size(), [&](std::size_t i) {
    findPlaces(geometry, data, surfaces.tiles[i], &(*outlooks)[i]);
    if (glints) findGlints(*glints, &(*outlooks)[i]);
    if (!sources.gather) findMirrorsOf(i);
  });
  if (!sources.gather) return;
  sources.gather->look(surfaces, outlooks);
  tbb::parallel_for(std::size_t{0}, surfaces.tiles.size(), findMirrorsOf);
}

void makeReady(const OutlookSources& sources, ReadySurfaces* ready) {
  findOutlooks(ready->surfaces, sources, &ready->outlooks);
  ready->table = LightTable(ready->surfaces, ready->outlooks, *sources.world.geometry->scene);
}

}  // namespace

void findOutlooks(const Surfaces& surfaces, const OutlookSources& sources, Outlooks* outlooks) {
  outlooks->resize(surfaces.tiles.size());
  tbb::parallel_for(std::size_t{0}, surfaces.tiles.size(),
                    [&](std::size_t i) { (*outlooks)[i].forget(surfaces.tiles[i].surfaces.size()); });
  if (sources.world.transport) findBaked(surfaces, sources, outlooks);
  if (sources.bodies) sources.bodies->hide(surfaces, sources.visibility, outlooks);
}

void makeReady(const OutlookSources& sources, ReadyPicture* picture) {
  makeReady(sources, &picture->seen);
  picture->mirrors.clear();
  const MirroredWorld world{*sources.world.geometry->scene, sources.visibility};
  while (picture->mirrors.size() < ReadyPicture::kMostMirrors) {
    const bool first = picture->mirrors.empty();
    ReadyMirrors next;
    next.reflections = reflect(first ? picture->seen.surfaces : picture->mirrors.back().met.surfaces,
                               first ? Onlooker::kCamera : Onlooker::kMirrors, world, &next.met.surfaces);
    if (next.reflections.tiles.empty()) return;
    // What mirrors show needs no closer look.
    makeReady({sources.world, sources.visibility, sources.bodies, nullptr}, &next.met);
    picture->mirrors.push_back(std::move(next));
  }
}

}  // namespace sunlit::light
