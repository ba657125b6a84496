/// A texture at all its sizes, as the picture looks it up.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "render/mipmaps.h"
#include "sunlit/scene/scene.h"

namespace sunlit::render {

/// Whether a texture cuts holes into what is made of it.
inline bool isMasked(const scene::Material& material) {
  return material.alpha_mode == scene::AlphaMode::kMask &&
         material.base_texture != scene::Material::kNoTexture;
}

class TexturePyramid {
 public:
  /// `alpha_cutoff` 0 … 1, or kNoCutoff or kBlends for a texture that masks nothing. Looks up the full size
  /// in `texture` itself, which must outlive it.
  TexturePyramid(const scene::Texture& texture, float alpha_cutoff);
  TexturePyramid(scene::Texture&&, float) = delete;
  /// Of smaller sizes that outlive it, too: smallerLevels() for this cutoff.
  TexturePyramid(const scene::Texture& texture, float alpha_cutoff,
                 const std::vector<scene::TextureSize>& smaller);

  /// Of the full size, in texels.
  Eigen::Array2f size() const { return size_; }

  /// Linear colour about texture coordinate `at`, of what is there if it blends: bilinear within a level,
  /// linear between two in the half about their middle. `level` 0 is the full size, each next one half of it.
  Eigen::Array3f color(const Eigen::Array2f& at, float level) const;

  /// A masked texture at one size.
  struct Mask {
    const std::uint8_t* alpha;
    int width, height;
    bool full;           ///< the full size
    std::uint8_t least;  ///< alpha of what is solid
  };
  /// The smallest size whose texels are not wider than the way from one sample to the next: of the full size
  /// so many texels, squared, lie on it. In smaller sizes the nearest texel decides what is solid: as many
  /// are as there is to show.
  Mask mask(float texels_squared) const;
  /// All sizes of a masked texture, the full one first.
  std::vector<Mask> masks() const;
  std::size_t sizes() const { return levels_.size(); }
  /// Of alpha, 0 … 255: what is solid between the texels of the full size reaches it.
  float cutoff() const { return cutoff_; }
  /// Whether it is solid at (u, v) of the full size: between texels, so that edges stay smooth.
  bool solid(float u, float v) const;

 private:
  struct Level {
    int width, height;
    const std::uint8_t* rgba;         ///< as scene::Texture
    std::vector<std::uint8_t> alpha;  ///< of a mask, by itself: it is looked up most
    Level(int width, int height, const std::uint8_t* rgba, bool masked);
  };
  Mask maskOf(const Level& level) const;

  std::vector<scene::TextureSize> smaller_;  ///< empty: they are kept elsewhere
  std::vector<Level> levels_;                ///< of the texture and of its smaller sizes
  Eigen::Array2f size_;
  float cutoff_;                 ///< of alpha, 0 … 255
  scene::Wrap wrap_u_, wrap_v_;  ///< of its colour
  bool repeats_;                 ///< in both directions
  bool blends_;
};

/// The number of what has no texture.
constexpr std::int32_t kNoPyramid = -1;

/// Of all textures that a scene's materials use: one a texture and cutoff.
class TexturePyramids {
 public:
  /// `scene` must outlive it.
  explicit TexturePyramids(const scene::Scene& scene);
  TexturePyramids(scene::Scene&&) = delete;

  /// Null for a material without a texture. One that masks nothing shares the sizes of its texture's first
  /// mask, if there is any.
  const TexturePyramid* of(std::int32_t material) const {
    const std::int32_t number = of_material_[static_cast<std::size_t>(material)];
    return number == kNoPyramid ? nullptr : &pyramids_[static_cast<std::size_t>(number)];
  }

 private:
  std::vector<TexturePyramid> pyramids_;
  std::vector<std::int32_t> of_material_;  ///< index into pyramids_
};

}  // namespace sunlit::render
