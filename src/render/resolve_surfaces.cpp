#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "render/resolve.h"
#include "render/tile_detail.h"

namespace sunlit::render {
namespace {

constexpr float kSameNormalCosine = 0.985f;  ///< 10°: shading changes by little more than its cosine, 1.5 %
constexpr float kSameDepthRatio = 0.1f;

/// One sample, unpacked.
struct Seeing {
  Eigen::Vector3f position, geometric_normal, shading_normal;
  Eigen::Array3f albedo;
  float depth;
  std::int32_t material;
  Eigen::Vector3f ray_origin;
  Eigen::Vector3f relative;  ///< to the camera, along the axes of `map`
};

/// The sum of alike samples.
struct Cluster {
  Seeing first;
  Eigen::Vector3f position, shading_normal;
  std::uint32_t samples = 0;
  std::array<Eigen::Vector3f, 16> origins, relatives;
  std::array<Eigen::Array3f, 16> albedos;

  bool alike(const Seeing& s) const {
    return s.material == first.material &&
           s.geometric_normal.dot(first.geometric_normal) > kSameNormalCosine &&
           s.shading_normal.dot(first.shading_normal) > kSameNormalCosine &&
           std::abs(s.depth - first.depth) < kSameDepthRatio * first.depth;
  }
  void start(const Seeing& s) {
    first = s;
    position = s.position;
    shading_normal = s.shading_normal;
    samples = 0;
    keep(s);
  }
  void add(const Seeing& s) {
    position += s.position;
    shading_normal += s.shading_normal;
    keep(s);
  }
  void keep(const Seeing& s) {
    origins[samples] = s.ray_origin;
    relatives[samples] = s.relative;
    albedos[samples] = s.albedo;
    ++samples;
  }
};

/// How far off its triangle a ray starts, m: above what single precision does to the point and to the
/// distance that the ray query computes, and well below what could let light through a wall.
float clearance(const Eigen::Vector3f& position, float depth) {
  return 2e-4f + 5e-7f * position.cwiseAbs().maxCoeff() + 1e-6f * depth;
}

class TileResolver {
 public:
  TileResolver(const Seen& seen, const SceneDetail& scene_detail, TileDetail* detail, light::Tile* tile)
      : seen_(seen), scene_detail_(scene_detail), detail_(*detail), tile_(*tile), eye_(seen.view.eye()) {}

  void resolve() {
    tile_.surfaces.clear();
    for (auto* origin : {&tile_.origin_x, &tile_.origin_y, &tile_.origin_z}) origin->clear();
    tile_.sky.assign(static_cast<std::size_t>(tile_.width * tile_.height), 0);
    for (int row = 0; row < tile_.height; ++row) {
      for (int column = 0; column < tile_.width; ++column) {
        tile_.sky[static_cast<std::size_t>(row * tile_.width + column)] =
            pixel(tile_.x + column, tile_.y + row);
      }
    }
    detail_.apply(scene_detail_, &tile_.surfaces);
  }

 private:
  /// Returns the number of samples that see the sky.
  std::uint8_t pixel(int x, int y) {
    const int s = seen_.view.supersampling;
    std::size_t clusters = 0;
    std::uint8_t sky = 0;
    for (int j = 0; j < s; ++j) {
      for (int i = 0; i < s; ++i) {
        const PackedSample& packed = seen_.sample(x * s + i, y * s + j);
        if (packed.sky()) {
          ++sky;
          continue;
        }
        const Seeing seeing = unpack(packed, x * s + i, y * s + j);
        std::size_t k = 0;
        while (k < clusters && !clusters_[k].alike(seeing)) ++k;
        if (k < clusters) {
          clusters_[k].add(seeing);
        } else {
          clusters_[clusters++].start(seeing);
        }
      }
    }
    for (std::size_t k = 0; k < clusters; ++k) append(clusters_[k], x, y);
    return sky;
  }

  Seeing unpack(const PackedSample& packed, int column, int row) const {
    Seeing seeing;
    const std::uint32_t triangle = packed.triangle - 1;
    const Eigen::Vector3d ray =
        seen_.view.ray(seen_.view.pixelOfSample(column), seen_.view.pixelOfSample(row));
    // The triangle's own plane is more exact than the rasteriser's depth; but on a sliver seen from the side
    // the sample may lie off its plane's visible part by any distance.
    double depth = planeDepth(seen_, triangle, ray);
    const double rasterised = packed.depth();
    if (!(std::abs(depth - rasterised) < 0.05 * rasterised)) depth = rasterised;
    seeing.depth = static_cast<float>(depth);
    seeing.position = (eye_ + depth * ray).cast<float>();
    seeing.relative = (depth * ray).cast<float>();
    seeing.material = seen_.geometry.materials[triangle];
    const Eigen::Vector3f& front = seen_.geometry.planes[triangle].normal;
    seeing.geometric_normal = front.dot(ray.cast<float>()) > 0.0f ? Eigen::Vector3f(-front) : front;
    seeing.ray_origin = seeing.position + clearance(seeing.position, seeing.depth) * seeing.geometric_normal;
    seeing.albedo = packed.linearAlbedo();
    const std::optional<Eigen::Vector3f> normal = packed.shadingNormal();
    if (!normal) {
      seeing.shading_normal = seeing.geometric_normal;
    } else {
      // Files get the side of normals wrong; the side that is seen is the one to light.
      const Eigen::Vector3f unit = normal->normalized();
      seeing.shading_normal = unit.dot(seeing.geometric_normal) < 0.0f ? Eigen::Vector3f(-unit) : unit;
    }
    return seeing;
  }

  /// What one sample covers of the cluster's plane, along its longer side, m: how far the point seen moves
  /// from one sample to the next.
  float footprint(const Cluster& cluster) const {
    const Eigen::Vector3f& point = cluster.first.relative;
    const Eigen::Vector3f& normal = cluster.first.geometric_normal;
    const Eigen::Vector3f along = point / normal.dot(point);
    float longest = 0.0f;
    for (const Eigen::Vector3f& step : {scene_detail_.sample_right, scene_detail_.sample_down}) {
      const Eigen::Vector3f across = step * cluster.first.depth;
      longest = std::max(longest, (across - along * normal.dot(across)).squaredNorm());
    }
    return std::sqrt(longest);
  }

  void append(const Cluster& cluster, int x, int y) {
    const float share = 1.0f / static_cast<float>(cluster.samples);
    light::Surface surface;
    surface.position = cluster.position * share;
    surface.to_eye = (eye_.cast<float>() - surface.position).normalized();
    surface.geometric_normal = cluster.first.geometric_normal;
    surface.shading_normal = cluster.shading_normal.normalized();
    surface.albedo = Eigen::Array3f::Zero();
    for (std::uint32_t i = 0; i < cluster.samples; ++i) surface.albedo += cluster.albedos[i];
    surface.albedo *= share;
    surface.material = cluster.first.material;
    surface.pixel = static_cast<std::uint32_t>(y * seen_.view.camera.width + x);
    surface.first_sample = static_cast<std::uint32_t>(tile_.origin_x.size());
    surface.samples = cluster.samples;
    if (scene_detail_.has(surface.material)) {
      detail_.add({static_cast<std::uint32_t>(tile_.surfaces.size()), surface.material, footprint(cluster),
                   cluster.samples, cluster.relatives.data(), cluster.albedos.data()});
    }
    tile_.surfaces.push_back(surface);
    for (std::uint32_t i = 0; i < cluster.samples; ++i) {
      tile_.origin_x.push_back(cluster.origins[i].x());
      tile_.origin_y.push_back(cluster.origins[i].y());
      tile_.origin_z.push_back(cluster.origins[i].z());
    }
  }

  const Seen& seen_;
  const SceneDetail& scene_detail_;
  TileDetail& detail_;
  light::Tile& tile_;
  Eigen::Vector3d eye_;
  std::array<Cluster, 16> clusters_;
};

void layOutTiles(const View& view, light::Surfaces* surfaces) {
  const int size = light::Surfaces::kTileSize;
  surfaces->width = view.camera.width;
  surfaces->height = view.camera.height;
  surfaces->samples_per_pixel = view.supersampling * view.supersampling;
  surfaces->pixel_origin = view.ray(0.0, 0.0).cast<float>();
  surfaces->pixel_right = (view.ray(1.0, 0.0) - view.ray(0.0, 0.0)).cast<float>();
  surfaces->pixel_down = (view.ray(0.0, 1.0) - view.ray(0.0, 0.0)).cast<float>();
  const int columns = (surfaces->width + size - 1) / size;
  const int rows = (surfaces->height + size - 1) / size;
  surfaces->tiles.resize(static_cast<std::size_t>(columns * rows));
  for (int i = 0; i < columns * rows; ++i) {
    light::Tile& tile = surfaces->tiles[static_cast<std::size_t>(i)];
    tile.x = i % columns * size;
    tile.y = i / columns * size;
    tile.width = std::min(size, surfaces->width - tile.x);
    tile.height = std::min(size, surfaces->height - tile.y);
  }
}

}  // namespace

double planeDepth(const Seen& seen, std::uint32_t triangle, const Eigen::Vector3d& ray) {
  const light::Plane& plane = seen.geometry.planes[triangle];
  const Eigen::Vector3d normal = plane.normal.cast<double>();
  return (plane.offset - normal.dot(seen.view.eye())) / normal.dot(ray);
}

void resolveSurfaces(const Seen& seen, light::Surfaces* surfaces) {
  layOutTiles(seen.view, surfaces);
  const SceneDetail scene_detail(*seen.geometry.scene, seen.view);
  tbb::parallel_for(std::size_t{0}, surfaces->tiles.size(), [&](std::size_t i) {
    thread_local TileDetail detail;  // keeps its memory
    TileResolver(seen, scene_detail, &detail, &surfaces->tiles[i]).resolve();
  });
}

}  // namespace sunlit::render
