#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "render/resolve.h"
#include "render/seen_triangle.h"
#include "render/tile_detail.h"

namespace sunlit::render {
namespace {

constexpr float kSameNormalCosine = 0.985f;  ///< 10°: shading changes by little more than its cosine, 1.5 %
constexpr float kSameDepthRatio = 0.1f;
constexpr std::size_t kMostSamples = 16;  ///< of a pixel

/// What some samples of a pixel see of one triangle.
struct Seeing {
  std::uint32_t triangle;
  std::int32_t material;
  Eigen::Vector3f geometric_normal, shading_normal;
  Eigen::Array3f albedo;
  float depth;             ///< of the first sample
  float footprint = 0.0f;  ///< of one sample, longer side, m; of materials with detail
  float shorter_m = 0.0f;  ///< likewise
  std::uint32_t samples = 0;
  const Eigen::Vector3f* relatives;  ///< where its samples are: to the camera, along the axes of `map`
};

/// Alike parts of a pixel.
struct Cluster {
  Seeing first;
  Eigen::Vector3f shading_normal;  ///< sum over the samples, and later unit
  Eigen::Array3f albedo;           ///< sum over the samples
  std::uint32_t samples = 0;
  std::array<Eigen::Vector3f, kMostSamples> relatives;

  bool alike(const Seeing& s) const {
    return s.material == first.material &&
           s.geometric_normal.dot(first.geometric_normal) > kSameNormalCosine &&
           s.shading_normal.dot(first.shading_normal) > kSameNormalCosine &&
           std::abs(s.depth - first.depth) < kSameDepthRatio * first.depth;
  }
  void start(const Seeing& s) {
    first = s;
    shading_normal.setZero();
    albedo.setZero();
    samples = 0;
    add(s);
  }
  void add(const Seeing& s) {
    shading_normal += static_cast<float>(s.samples) * s.shading_normal;
    albedo += static_cast<float>(s.samples) * s.albedo;
    for (std::uint32_t i = 0; i < s.samples; ++i) relatives[samples++] = s.relatives[i];
  }
};

/// The triangles that were looked at last.
class TriangleCache {
 public:
  void forget() { numbers_.fill(kNone); }
  const SeenTriangle& at(const Seen& seen, std::uint32_t number) {
    const std::size_t slot = number % kSlots;
    if (numbers_[slot] != number) {
      numbers_[slot] = number;
      triangles_[slot] = SeenTriangle(seen, number);
    }
    return triangles_[slot];
  }

 private:
  static constexpr std::size_t kSlots = 64;
  static constexpr std::uint32_t kNone = 0xffffffffu;
  std::array<std::uint32_t, kSlots> numbers_;
  std::array<SeenTriangle, kSlots> triangles_;
};

class TileResolver {
 public:
  /// What stays from tile to tile, one a thread.
  struct Memory {
    TileDetail detail;
    TriangleCache triangles;
    std::array<Cluster, kMostSamples> clusters;
  };
  TileResolver(const Seen& seen, const SceneDetail& scene_detail, Memory* memory, light::Tile* tile)
      : seen_(seen),
        scene_detail_(scene_detail),
        memory_(*memory),
        tile_(*tile),
        ray_(seen.view.ray(seen.view.pixelOfSample(0), seen.view.pixelOfSample(0)).cast<float>()),
        eye_high_(seen.view.eye().cast<float>()),
        eye_low_((seen.view.eye() - eye_high_.cast<double>()).cast<float>()),
        kept_(1.0f - scene_detail.sample_right.norm() / 16.0f),
        per_pixel_(static_cast<std::uint32_t>(seen.view.supersampling * seen.view.supersampling)) {
    for (std::size_t i = 0; i < sides_.size(); ++i) sides_[i] = std::sqrt(static_cast<float>(i));
  }

  void resolve() {
    memory_.triangles.forget();
    tile_.surfaces.clear();
    const auto pixels = static_cast<std::size_t>(tile_.width * tile_.height);
    for (auto* origin : {&tile_.origin_x, &tile_.origin_y, &tile_.origin_z})
      origin->resize(pixels * per_pixel_);
    tile_.sky.assign(pixels, 0);
    for (int row = 0; row < tile_.height; ++row) {
      for (int column = 0; column < tile_.width; ++column) {
        tile_.sky[static_cast<std::size_t>(row * tile_.width + column)] =
            pixel(tile_.x + column, tile_.y + row);
      }
    }
    for (auto* origin : {&tile_.origin_x, &tile_.origin_y, &tile_.origin_z}) origin->resize(origins_);
    memory_.detail.apply(scene_detail_, &tile_.surfaces);
  }

 private:
  Eigen::Vector3f relative(const Sample& sample, int column, int row) const {
    return sample.depth * (ray_ + static_cast<float>(column) * scene_detail_.sample_right +
                           static_cast<float>(row) * scene_detail_.sample_down);
  }

  /// All samples of the pixel see one triangle.
  void wholePixel(const std::array<Sample, kMostSamples>& samples, int x, int y) {
    const int s = seen_.view.supersampling;
    Cluster& cluster = memory_.clusters[0];
    cluster.samples = 0;
    for (int row = y * s; row < (y + 1) * s; ++row) {
      for (int column = x * s; column < (x + 1) * s; ++column, ++cluster.samples)
        cluster.relatives[cluster.samples] = relative(samples[cluster.samples], column, row);
    }
    Seeing& seeing = cluster.first;
    seeing.depth = samples[0].depth;
    seeing.relatives = cluster.relatives.data();
    seeing.samples = cluster.samples;
    look(samples[0].triangle - 1, &seeing);
    cluster.albedo = static_cast<float>(cluster.samples) * seeing.albedo;
    cluster.shading_normal = seeing.shading_normal;
    append(cluster, x, y);
  }

  /// Returns the number of samples that see the sky.
  std::uint8_t pixel(int x, int y) {
    const int s = seen_.view.supersampling;
    std::array<Sample, kMostSamples> samples;
    std::size_t count = 0;
    for (int j = 0; j < s; ++j)
      for (int i = 0; i < s; ++i) samples[count++] = seen_.sample(x * s + i, y * s + j);
    bool same = true;
    for (std::size_t i = 1; i < count; ++i) same &= samples[i].triangle == samples[0].triangle;
    if (same && samples[0].sky()) return static_cast<std::uint8_t>(count);
    if (same) {
      wholePixel(samples, x, y);
      return 0;
    }
    std::size_t clusters = 0;
    std::uint8_t sky = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t triangle = samples[i].triangle;
      if (triangle == 0) ++sky;
      if (triangle == 0 || triangle == kTaken) continue;
      std::array<Eigen::Vector3f, kMostSamples> relatives;
      Seeing seeing;
      seeing.depth = samples[i].depth;
      seeing.relatives = relatives.data();
      for (std::size_t k = i; k < count; ++k) {
        if (samples[k].triangle != triangle) continue;
        samples[k].triangle = kTaken;
        const int column = x * s + static_cast<int>(k) % s, row = y * s + static_cast<int>(k) / s;
        relatives[seeing.samples++] = relative(samples[k], column, row);
      }
      look(triangle - 1, &seeing);
      std::size_t k = 0;
      while (k < clusters && !memory_.clusters[k].alike(seeing)) ++k;
      if (k < clusters) {
        memory_.clusters[k].add(seeing);
      } else {
        memory_.clusters[clusters++].start(seeing);
      }
    }
    for (std::size_t k = 0; k < clusters; ++k) {
      memory_.clusters[k].shading_normal.normalize();
      append(memory_.clusters[k], x, y);
    }
    return sky;
  }

  /// Fills in what follows from the triangle and the points seen.
  void look(std::uint32_t number, Seeing* seeing) {
    const SeenTriangle& triangle = memory_.triangles.at(seen_, number);
    Eigen::Vector3f middle = Eigen::Vector3f::Zero();
    for (std::uint32_t i = 0; i < seeing->samples; ++i) middle += seeing->relatives[i];
    middle /= static_cast<float>(seeing->samples);
    seeing->triangle = number;
    seeing->material = triangle.material();
    seeing->geometric_normal = triangle.geometricNormal();
    const Eigen::Array2f shares = triangle.sharesAt(middle);
    seeing->shading_normal = triangle.shadingNormal(shares);
    Footprint step =
        triangle.footprint(middle, seeing->depth, scene_detail_.sample_right, scene_detail_.sample_down);
    if (scene_detail_.has(seeing->material)) {
      const float right = step.right.norm(), down = step.down.norm();
      seeing->footprint = std::max(right, down);
      seeing->shorter_m = std::min(right, down);
    }
    // All of these samples together span so many along each side.
    const float side = sides_[seeing->samples];
    step.right *= side;
    step.down *= side;
    seeing->albedo = triangle.albedo(seen_, shares, step, 4 * seeing->samples <= per_pixel_);
  }

  void append(const Cluster& cluster, int x, int y) {
    const float share = 1.0f / static_cast<float>(cluster.samples);
    const auto number = static_cast<std::uint32_t>(tile_.surfaces.size());
    tile_.surfaces.push_back(blank_);
    light::Surface& surface = tile_.surfaces.back();
    surface.geometric_normal = cluster.first.geometric_normal;
    surface.shading_normal = cluster.shading_normal;
    Eigen::Vector3f middle = Eigen::Vector3f::Zero();
    for (std::uint32_t i = 0; i < cluster.samples; ++i) middle += cluster.relatives[i];
    middle *= share;
    surface.albedo = share * cluster.albedo;
    surface.position = eye_high_ + (middle + eye_low_);
    surface.to_eye = -middle.normalized();
    surface.material = cluster.first.material;
    const scene::Material& material = seen_.look(surface.material);
    surface.emission = material.emission.value;
    surface.roughness = material.roughness;
    surface.metalness = material.metalness;
    surface.clearance_m = light::rayClearance_m(surface.position, cluster.first.depth);
    surface.triangle = cluster.first.triangle;
    surface.pixel = static_cast<std::uint32_t>(y * seen_.view.camera.width + x);
    surface.first_sample = static_cast<std::uint32_t>(origins_);
    surface.samples = cluster.samples;
    if (scene_detail_.has(surface.material)) {
      const Seeing& seeing = cluster.first;
      memory_.detail.add({number, surface.material, seeing.footprint,
                          detailSpread_m(cluster.samples, seeing.footprint, seeing.shorter_m), middle});
    }
    const Eigen::Vector3f to_origin = eye_low_ + surface.clearance_m * surface.geometric_normal;
    const float kept = material.transmission > 0.0f ? 1.0f : kept_;
    for (std::uint32_t i = 0; i < cluster.samples; ++i, ++origins_) {
      const Eigen::Vector3f origin = eye_high_ + (kept * cluster.relatives[i] + to_origin);
      tile_.origin_x[origins_] = origin.x();
      tile_.origin_y[origins_] = origin.y();
      tile_.origin_z[origins_] = origin.z();
    }
  }

  static constexpr std::uint32_t kTaken = 0xffffffffu;  ///< a sample that is dealt with

  const Seen& seen_;
  const SceneDetail& scene_detail_;
  Memory& memory_;
  light::Tile& tile_;
  std::size_t origins_ = 0;             ///< written so far
  Eigen::Vector3f ray_;                 ///< of sample (0, 0), of depth 1 m
  Eigen::Vector3f eye_high_, eye_low_;  ///< whose sum is the eye
  /// Part of the way from the eye at which shadow rays start. Rounded corners let a sample at an edge be
  /// taken for the surface beside it, and its ray start beyond that edge, where the sun may shine. A
  /// sixteenth of a sample towards the eye, which sees both surfaces, brings it back. Thin sheets send rays
  /// to both sides: for them 1.
  float kept_;
  const light::Surface blank_{};               ///< copied faster than made
  std::uint32_t per_pixel_;                    ///< samples
  std::array<float, kMostSamples + 1> sides_;  ///< of a square of so many samples
};

void layOutTiles(const View& view, light::Surfaces* surfaces) {
  const int size = light::Surfaces::kTileSize;
  surfaces->width = view.camera.width;
  surfaces->height = view.camera.height;
  surfaces->samples_per_pixel = view.supersampling * view.supersampling;
  surfaces->eye = view.eye().cast<float>();
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
  const light::Plane& plane = seen.plane(triangle);
  const Eigen::Vector3d normal = plane.normal.cast<double>();
  return (plane.offset - normal.dot(seen.view.eye())) / normal.dot(ray);
}

void resolveSurfaces(const Seen& seen, light::Surfaces* surfaces) {
  layOutTiles(seen.view, surfaces);
  surfaces->table.reset();  // of other surfaces
  const SceneDetail scene_detail(*seen.geometry.scene, seen.view);
  tbb::parallel_for(std::size_t{0}, surfaces->tiles.size(), [&](std::size_t i) {
    thread_local TileResolver::Memory memory;
    TileResolver(seen, scene_detail, &memory, &surfaces->tiles[i]).resolve();
  });
}

}  // namespace sunlit::render
