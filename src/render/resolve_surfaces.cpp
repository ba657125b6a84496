#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "render/cluster.h"
#include "render/lens_canvas.h"
#include "render/resolve.h"
#include "render/tile_detail.h"
#include "sunlit/light/reflection.h"

namespace sunlit::render {
namespace {

class TileResolver {
 public:
  /// One part of a triangle that is seen through, within a pixel.
  struct Veil {
    std::uint32_t triangle;
    float depth;
    std::vector<Eigen::Vector3f> relatives = {};
    Eigen::Array3f covered = Eigen::Array3f::Zero();  ///< sum over the samples of what is seen of it
    Eigen::Array3f stopped = Eigen::Array3f::Zero();  ///< likewise, of what it hides of what is behind
  };

  /// What stays from tile to tile, one a thread.
  struct Memory {
    TileDetail detail;
    TriangleCache triangles;
    std::array<Cluster, kMostSamples> clusters;
    std::vector<light::Hit> hits;
    std::vector<Veil> veils;
  };
  TileResolver(const Seen& seen, const SceneDetail& scene_detail, Memory* memory, light::Tile* tile)
      : seen_(seen),
        scene_detail_(scene_detail),
        memory_(*memory),
        tile_(*tile),
        ray_(seen.view.ray(seen.view.pixelOfSample(0), seen.view.pixelOfSample(0)).cast<float>()),
        eye_high_(seen.view.eye().cast<float>()),
        eye_low_((seen.view.eye() - eye_high_.cast<double>()).cast<float>()),
        lens_(seen.view.lens.get()),
        map_from_optical_(seen.view.map_from_optical.linear().cast<float>()),
        right_(scene_detail.sample_right),
        down_(scene_detail.sample_down),
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
    tile_.sky_share.assign(seen_.veils ? pixels : 0, Eigen::Array3f::Ones());
    for (int row = 0; row < tile_.height; ++row) {
      for (int column = 0; column < tile_.width; ++column) {
        if (lens_) aim(tile_.x + column, tile_.y + row);
        tile_.sky[static_cast<std::size_t>(row * tile_.width + column)] =
            seen_.veils ? veiledPixel(tile_.x + column, tile_.y + row)
                        : pixel(tile_.x + column, tile_.y + row);
      }
    }
    for (auto* origin : {&tile_.origin_x, &tile_.origin_y, &tile_.origin_z}) origin->resize(origins_);
    memory_.detail.apply(scene_detail_, &tile_.surfaces);
  }

 private:
  /// A place on a triangle.
  struct Spot {
    Eigen::Array2f shares;
    Footprint step;
    bool small;
  };

  Eigen::Vector3f relative(const Sample& sample, int column, int row) const {
    if (lens_) return sample.depth * (map_from_optical_ * lens_->ray(column, row));
    return sample.depth * (ray_ + static_cast<float>(column) * scene_detail_.sample_right +
                           static_cast<float>(row) * scene_detail_.sample_down);
  }

  /// Turns right_ and down_ to a pixel of a lens.
  void aim(int x, int y) {
    const float part = 1.0f / static_cast<float>(seen_.view.supersampling);
    right_ = part * (map_from_optical_ * lens_->pixels()->right(x, y).cast<float>());
    down_ = part * (map_from_optical_ * lens_->pixels()->down(x, y).cast<float>());
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
    cluster.mapped = seeing.mapped;
    cluster.unveiled.setZero();
    for (std::uint32_t i = 0; seen_.veils && i < cluster.samples; ++i) cluster.unveiled += unveiled_[i];
    if (seeing.mapped) {
      cluster.finish = Finish();
      cluster.finish.add(static_cast<float>(cluster.samples), seeing.finish);
    }
    append(cluster, x, y);
  }

  /// As pixel(), with what is seen through before it: each sample's ray passes layer by layer, and each takes
  /// its alpha of what is left.
  std::uint8_t veiledPixel(int x, int y) {
    const int s = seen_.view.supersampling;
    memory_.veils.clear();
    Eigen::Array3f sky = Eigen::Array3f::Zero();
    for (int k = 0; k < s * s; ++k) {
      const int column = x * s + k % s, row = y * s + k / s;
      const Sample& sample = seen_.sample(column, row);
      const Eigen::Array3f left = passVeils(sample, column, row);
      unveiled_[static_cast<std::size_t>(k)] = left;
      if (sample.sky()) sky += left;
    }
    const std::uint8_t samples = pixel(x, y);
    if (samples > 0)
      tile_.sky_share[static_cast<std::size_t>((y - tile_.y) * tile_.width + x - tile_.x)] =
          sky / static_cast<float>(samples);
    for (const Veil& veil : memory_.veils) appendVeil(veil, x, y);
    return samples;
  }

  /// What is left of a sample behind all that it is seen through, which goes to Memory::veils.
  Eigen::Array3f passVeils(const Sample& sample, int column, int row) {
    const Eigen::Vector3f ray = relative({0, 1.0f}, column, row);
    const float far = sample.sky() ? static_cast<float>(seen_.view.far_m) : sample.depth;
    seen_.veils->veils({eye_high_ + eye_low_, ray, static_cast<float>(seen_.view.near_m), far},
                       &memory_.hits);
    Eigen::Array3f left = Eigen::Array3f::Ones();
    for (const light::Hit& hit : memory_.hits) {
      const Eigen::Vector3f point = hit.distance * ray;
      const SeenTriangle& triangle = memory_.triangles.at(seen_, hit.triangle);
      // What lies on a surface, as a box's bottom on the ground, is hidden, as from that surface's own rays.
      const float above_m = (far - hit.distance) * std::abs(triangle.geometricNormal().dot(ray));
      if (!sample.sky() && above_m < light::rayClearance_m(eye_high_ + point, far)) continue;
      const Footprint step = triangle.footprint(point, hit.distance, right_, down_);
      const Eigen::Array2f shares = triangle.sharesAt(point);
      // Glass sends its own light whole, and lets through what it does not mirror.
      const bool glass = light::isGlass(seen_.look(triangle.material()));
      const float alpha =
          glass ? 1.0f
                : seen_.maps.alpha(triangle.material(), triangle.placeOnMaps(seen_, shares, step, false));
      Eigen::Array3f through = Eigen::Array3f::Constant(1.0f - alpha);
      if (glass) through = throughGlass(triangle, {shares, step, false}, -ray.normalized());
      if (!(alpha > 0.0f)) continue;
      std::vector<Veil>& veils = memory_.veils;
      auto veil =
          std::find_if(veils.begin(), veils.end(), [&](const Veil& v) { return v.triangle == hit.triangle; });
      if (veil == veils.end()) veil = veils.insert(veil, Veil{hit.triangle, hit.distance});
      if (veil->relatives.size() == kMostSamples) continue;
      veil->relatives.push_back(point);
      veil->covered += left * alpha;
      veil->stopped += left * (1.0f - through);
      left *= through;
    }
    return left;
  }

  /// Share of the light that a clear sheet lets through to the eye.
  Eigen::Array3f throughGlass(const SeenTriangle& triangle, const Spot& spot,
                              const Eigen::Vector3f& to_eye) const {
    const scene::Material& material = seen_.look(triangle.material());
    light::Reflection reflection = {triangle.shadingNormal(spot.shares), to_eye,
                                    triangle.albedo(seen_, spot.shares, spot.step, spot.small)};
    reflection.metalness = material.metalness;
    if (material.metalness_map.given()) {
      const SurfaceMaps::Place place = triangle.placeOnMaps(seen_, spot.shares, spot.step, spot.small);
      reflection.metalness = seen_.maps.finish(triangle.material(), place).metalness;
    }
    reflection.dielectric = material.dielectric.value;
    reflection.dielectric_grazing = material.dielectric_grazing;
    reflection.glass = material.glass;
    return light::straightThrough(reflection);
  }

  void appendVeil(const Veil& veil, int x, int y) {
    Seeing seeing;
    seeing.depth = veil.depth;
    seeing.relatives = veil.relatives.data();
    seeing.samples = static_cast<std::uint32_t>(veil.relatives.size());
    look(veil.triangle, &seeing);
    Cluster& cluster = memory_.clusters[0];
    cluster.start(seeing);
    cluster.shading_normal.normalize();
    cluster.unveiled = veil.covered;
    append(cluster, x, y);
    tile_.surfaces.back().air_share = veil.stopped / static_cast<float>(cluster.samples);
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
      Eigen::Array3f unveiled = Eigen::Array3f::Zero();
      for (std::size_t k = i; k < count; ++k) {
        if (samples[k].triangle != triangle) continue;
        samples[k].triangle = kTaken;
        if (seen_.veils) unveiled += unveiled_[k];
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
      memory_.clusters[k].unveiled += unveiled;
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
    Footprint step = triangle.footprint(middle, seeing->depth, right_, down_);
    if (scene_detail_.has(seeing->material)) {
      const float right = step.right.norm(), down = step.down.norm();
      seeing->footprint = std::max(right, down);
      seeing->shorter_m = std::min(right, down);
    }
    // All of these samples together span so many along each side.
    const float side = sides_[seeing->samples];
    step.right *= side;
    step.down *= side;
    const bool small = 4 * seeing->samples <= per_pixel_;
    seeing->albedo = triangle.albedo(seen_, shares, step, small);
    seeing->mapped = seen_.maps.has(seeing->material);
    if (seeing->mapped) lookAtMaps(triangle, {shares, step, small}, seeing);
  }

  void lookAtMaps(const SeenTriangle& triangle, const Spot& spot, Seeing* seeing) const {
    const SurfaceMaps::Place place = triangle.placeOnMaps(seen_, spot.shares, spot.step, spot.small);
    seeing->finish = seen_.maps.finish(seeing->material, place);
    Eigen::Vector3f mapped;
    if (!seen_.maps.normal(seeing->material, place, &mapped)) return;
    const float length = triangle.mapNormal(seen_, spot.shares, mapped, &seeing->shading_normal);
    seeing->finish.roughness = widenedRoughness(seeing->finish.roughness, length);
  }

  void append(const Cluster& cluster, int x, int y) {
    const float share = 1.0f / static_cast<float>(cluster.samples);
    const auto number = static_cast<std::uint32_t>(tile_.surfaces.size());
    // What is seen through has samples beside those of the picture.
    if (seen_.veils && origins_ + cluster.samples > tile_.origin_x.size()) {
      for (auto* origin : {&tile_.origin_x, &tile_.origin_y, &tile_.origin_z})
        origin->resize(2 * (origins_ + cluster.samples));
    }
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
    if (cluster.mapped) {
      surface.emission = share * cluster.finish.emission;
      surface.roughness = share * cluster.finish.roughness;
      surface.metalness = share * cluster.finish.metalness;
      surface.cavity = share * cluster.finish.cavity;
    } else {
      surface.emission = material.emission.value;
      surface.roughness = material.roughness;
      surface.metalness = material.metalness;
    }
    surface.clearance_m = light::rayClearance_m(surface.position, cluster.first.depth);
    surface.triangle = cluster.first.triangle;
    surface.pixel = static_cast<std::uint32_t>(y * seen_.view.camera.width + x);
    surface.first_sample = static_cast<std::uint32_t>(origins_);
    surface.samples = cluster.samples;
    if (seen_.veils) surface.share = surface.air_share = share * cluster.unveiled;
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
  std::size_t origins_ = 0;                              ///< written so far
  std::array<Eigen::Array3f, kMostSamples> unveiled_{};  ///< of the pixel's samples, what is seen of them
  Eigen::Vector3f ray_;                                  ///< of sample (0, 0), of depth 1 m
  Eigen::Vector3f eye_high_, eye_low_;                   ///< whose sum is the eye
  const LensCanvas* lens_;                               ///< null: a pinhole
  Eigen::Matrix3f map_from_optical_;
  Eigen::Vector3f right_, down_;  ///< from one sample to the next, of depth 1 m
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
  surfaces->pixel_right = view.pixelRight().cast<float>();
  surfaces->pixel_down = view.pixelDown().cast<float>();
  surfaces->bent = view.lens ? view.lens->pixels() : nullptr;
  surfaces->map_from_optical = view.map_from_optical.linear();
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

void resolveSurfaces(const Seen& seen, light::Surfaces* surfaces) {
  layOutTiles(seen.view, surfaces);
  const SceneDetail scene_detail(*seen.geometry.scene, seen.view);
  tbb::parallel_for(std::size_t{0}, surfaces->tiles.size(), [&](std::size_t i) {
    thread_local TileResolver::Memory memory;
    TileResolver(seen, scene_detail, &memory, &surfaces->tiles[i]).resolve();
  });
}

}  // namespace sunlit::render
