/// What textures say of surfaces beside their colour.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "render/map_pyramid.h"
#include "sunlit/scene/scene.h"

namespace sunlit::render {

/// Of one place, or the sum over several.
struct Finish {
  Eigen::Array3f emission = Eigen::Array3f::Zero();  ///< cd/m²
  float roughness = 0.0f, metalness = 0.0f, cavity = 0.0f;

  void add(float weight, const Finish& other);
};

/// Of all materials of a scene that have such textures.
class SurfaceMaps {
 public:
  /// Ambient light within `known_m` of a surface is known without its map of occlusion, which then counts by
  /// what it says beyond its own mean over such a distance; zero: nothing is known.
  SurfaceMaps(const scene::Scene& scene, float known_m);

  bool has(std::int32_t material) const { return used_[static_cast<std::size_t>(material)].any; }

  /// A place on a triangle.
  struct Place {
    /// Its texture coordinates in set `of`, and the sides of what is seen of it.
    struct Coordinates {
      bool known = false;
      TextureArea::Spot spot;
    };
    std::vector<Coordinates> sets;  ///< by scene::TextureUse::coordinates
    float right_m;                  ///< length of the side `right`
    TextureArea::Filter filter;
  };
  Finish finish(std::int32_t material, const Place& place) const;
  /// In the frame of the texture, not of length 1: the shorter, the more normals differ within the place.
  /// False without a map of normals.
  bool normal(std::int32_t material, const Place& place, Eigen::Vector3f* normal) const;
  /// Of a material that blends.
  float alpha(std::int32_t material, const Place& place) const;
  int normalCoordinates(std::int32_t material) const;
  /// Sets that the material's maps use are below.
  int sets(std::int32_t material) const { return used_[static_cast<std::size_t>(material)].sets; }

 private:
  /// Indices into pyramids_.
  struct Used {
    static constexpr int kNone = -1;
    bool any = false;
    int sets = 0;
    int roughness = kNone, metalness = kNone, normals = kNone, occlusion = kNone, emission = kNone;
    int alpha = kNone;
  };
  int pyramidOf(const scene::TextureUse& use, MapPyramid::Kind kind, Used* used);
  float cavity(const scene::Material& material, const Used& used, const Place& place) const;

  const scene::Scene& scene_;
  float known_m_;
  std::vector<Used> used_;  ///< by material
  struct Wanted {
    int texture;
    MapPyramid::Kind kind;
  };
  std::vector<Wanted> wanted_;
  std::vector<std::unique_ptr<MapPyramid>> pyramids_;  ///< of wanted_
};

/// Perceptual roughness of a surface whose normals have a mean of length `mean` where it is looked at: their
/// spread widens the lobe (Toksvig 2005, with Blinn's exponent as 2 / α²): α² grows by 2 (1 − mean) / mean.
float widenedRoughness(float roughness, float mean);

}  // namespace sunlit::render
