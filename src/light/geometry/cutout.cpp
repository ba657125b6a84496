#include "light/geometry/cutout.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "sunlit/light/reflection.h"
#include "sunlit/light/visibility.h"
#include "sunlit/scene/whole_texture.h"

namespace sunlit::light {
namespace {

constexpr int kNoMask = -1, kNowhere = -2;

/// What blends by its factor alone.
const scene::Texture& white() {
  static const scene::Texture texture{"white", 1, 1, {255, 255, 255, 255}};
  return texture;
}

/// What comes through a sheet of glass.
struct ThroughGlass {
  std::vector<float> shares;  ///< of luminance, by steps of the cosine to its normal from 0 to 1
  Eigen::Array3f tint;        ///< colour of it, of luminance 1, on its straight way
};

ThroughGlass throughGlass(const scene::Material& material) {
  Reflection reflection = {Eigen::Vector3f::UnitZ(), Eigen::Vector3f::UnitZ(), material.base_color.value};
  reflection.metalness = material.metalness;
  reflection.dielectric = material.dielectric.value;
  reflection.dielectric_grazing = material.dielectric_grazing;
  reflection.glass = material.glass;
  constexpr int kSteps = 64;
  ThroughGlass through{{}, Eigen::Array3f::Ones()};
  for (int i = 0; i <= kSteps; ++i) {
    const float cosine = static_cast<float>(i) / kSteps;
    reflection.to_eye = Eigen::Vector3f(std::sqrt(1.0f - cosine * cosine), 0.0f, cosine);
    const Eigen::Array3f color = straightThrough(reflection);
    through.shares.push_back(LinearRgb(color).luminance());
    if (i == kSteps && through.shares.back() > 0.0f) through.tint = color / through.shares.back();
  }
  return through;
}

float atCosine(const std::vector<float>& through, float cosine) {
  const float at = cosine * static_cast<float>(through.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(at), through.size() - 2);
  return through[below] + (at - static_cast<float>(below)) * (through[below + 1] - through[below]);
}

/// Of even light from a half sphere.
float mean(const std::vector<float>& through) {
  constexpr int kParts = 64;  // of equal irradiance: even in the square of the cosine
  float sum = 0.0f;
  for (int i = 0; i < kParts; ++i)
    sum += atCosine(through, std::sqrt((static_cast<float>(i) + 0.5f) / kParts));
  return sum / kParts;
}

/// Evenly spread over 0 … 1, and alike for no neighbours.
float hashed(std::uint32_t triangle, float u, float v) {
  std::uint32_t a, b;
  std::memcpy(&a, &u, sizeof(a));
  std::memcpy(&b, &v, sizeof(b));
  std::uint32_t h = a * 0x9e3779b1u ^ (b + 0x85ebca6bu) * 0xc2b2ae35u ^ triangle * 0x27d4eb2fu;
  h = (h ^ (h >> 16)) * 0x7feb352du;
  h = (h ^ (h >> 15)) * 0x846ca68bu;
  h ^= h >> 16;
  return static_cast<float>(h >> 8) * (1.0f / (1u << 24));
}

bool isListed(const scene::Scene& scene, const scene::Material& material, Cutouts::Veils veils) {
  switch (veils) {
    case Cutouts::Veils::kLeftOut:
      return !isGlass(material) && !blendsEvenly(scene, material);
    case Cutouts::Veils::kEvenOnly:
      return blendsEvenly(scene, material);
    default:
      return true;
  }
}

}  // namespace

bool blendsEvenly(const scene::Scene& scene, const scene::Material& material) {
  if (material.alpha_mode != scene::AlphaMode::kBlend) return false;
  return material.base_texture == scene::Material::kNoTexture ||
         scene::isWhole(scene.textures[static_cast<std::size_t>(material.base_texture)]);
}

Cutouts::Mask::Mask(const scene::Texture& source, float alpha_cutoff)
    : texture(&source),
      width(source.width),
      height(source.height),
      cutoff(alpha_cutoff * 255.0f),
      alpha(source.rgba.size() / 4),
      blocks_a_row((source.width + 15) / 16) {
  for (std::size_t p = 0; p < alpha.size(); ++p) alpha[p] = source.rgba[4 * p + 3];
  squares.resize(static_cast<std::size_t>(blocks_a_row * ((height + 15) / 16)) * 16);
  const auto solid = [this](int x, int y) {
    return static_cast<float>(alpha[static_cast<std::size_t>(y % height) * static_cast<std::size_t>(width) +
                                    static_cast<std::size_t>(x % width)]) >= cutoff
               ? 1
               : 0;
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int corners = solid(x, y) + solid(x + 1, y) + solid(x, y + 1) + solid(x + 1, y + 1);
      const unsigned kind = corners == 0 ? kClear : corners == 4 ? kSolid : kMixed;
      squares[word(x, y)] |= kind << (2 * (x & 15));
    }
  }
}

float Cutouts::Mask::interpolated(int x0, int y0, float fx, float fy) const {
  const int x1 = x0 + 1 == width ? 0 : x0 + 1;
  const int y1 = y0 + 1 == height ? 0 : y0 + 1;
  const auto at = [this](int x, int y) {
    return static_cast<float>(
        alpha[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)]);
  };
  const float top = at(x0, y0) + fx * (at(x1, y0) - at(x0, y0));
  const float bottom = at(x0, y1) + fx * (at(x1, y1) - at(x0, y1));
  return top + fy * (bottom - top);
}

Cutouts::Triangle Cutouts::Mask::place(const std::array<Eigen::Vector2f, 3>& texture_coordinates) const {
  const Eigen::Array2f size(static_cast<float>(width), static_cast<float>(height));
  const Eigen::Array2f low =
      texture_coordinates[0].cwiseMin(texture_coordinates[1]).cwiseMin(texture_coordinates[2]);
  const Eigen::Array2f high =
      texture_coordinates[0].cwiseMax(texture_coordinates[1]).cwiseMax(texture_coordinates[2]);
  // By whole turns near to 0, where texels are told apart best.
  const Eigen::Array2f turns(std::floor(low.x()), std::floor(low.y()));
  const auto texels = [&](const Eigen::Vector2f& at) {
    return Eigen::Vector2f((at.array() - turns) * size - 0.5f);
  };
  Triangle triangle;
  triangle.origin = texels(texture_coordinates[0]);
  triangle.along_u = texels(texture_coordinates[1]) - triangle.origin;
  triangle.along_v = texels(texture_coordinates[2]) - triangle.origin;
  triangle.repeats = (high - turns > 1.0f).any();
  return triangle;
}

float Cutouts::Query::alpha(float u, float v) const {
  const Place at = placeOf(u, v);
  return mask_.blended * mask_.interpolated(at.x0, at.y0, at.fx, at.fy) / 255.0f;
}

float Cutouts::Query::share(float u, float v, float cosine) const {
  return mask_.through.empty() ? alpha(u, v) : 1.0f - atCosine(mask_.through, std::min(cosine, 1.0f));
}

bool Cutouts::Query::isThere(float share, float u, float v) const {
  return share > hashed(number_, u, v);
}

// Squares first, without a branch, so that one look-up need not wait for another.
void Cutouts::Query::solid(const float* u, const float* v, std::size_t count, std::uint8_t* solid) const {
  if (blends()) {
    for (std::size_t i = 0; i < count; ++i) solid[i] = isThere(alpha(u[i], v[i]), u[i], v[i]) ? 1 : 0;
    return;
  }
  for (std::size_t i = 0; i < count; ++i) {
    const Place at = placeOf(u[i], v[i]);
    solid[i] = static_cast<std::uint8_t>(mask_.square(at.x0, at.y0));
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (solid[i] != Mask::kMixed) continue;
    const Place at = placeOf(u[i], v[i]);
    solid[i] = mask_.interpolated(at.x0, at.y0, at.fx, at.fy) >= mask_.cutoff ? 1 : 0;
  }
}

std::int32_t Cutouts::maskOf(const scene::Texture& texture, float alpha_cutoff, float blended) {
  const auto same = std::find_if(masks_.begin(), masks_.end(), [&](const Mask& mask) {
    return mask.texture == &texture && mask.cutoff == alpha_cutoff * 255.0f && mask.blended == blended &&
           mask.through.empty();
  });
  const auto index = static_cast<std::int32_t>(same - masks_.begin());
  if (same == masks_.end()) {
    masks_.emplace_back(texture, alpha_cutoff);
    masks_.back().blended = blended;
  }
  return index;
}

std::int32_t Cutouts::maskOfGlass(const scene::Material& material) {
  ThroughGlass through = throughGlass(material);
  const auto same = std::find_if(masks_.begin(), masks_.end(), [&](const Mask& mask) {
    return mask.through == through.shares && (mask.tint == through.tint).all();
  });
  const auto index = static_cast<std::int32_t>(same - masks_.begin());
  if (same == masks_.end()) {
    masks_.emplace_back(white(), 0.0f);
    masks_.back().blended = 1.0f - mean(through.shares);
    masks_.back().through = std::move(through.shares);
    masks_.back().tint = through.tint;
  }
  return index;
}

Cutouts::Cutouts(const Geometry& geometry, Veils veils) {
  const scene::Scene& scene = *geometry.scene;
  std::vector<std::int32_t> mask_of(scene.materials.size(), kNoMask);
  // Bodies share the materials of the whole scene and use few of them.
  std::vector<bool> used(scene.materials.size(), false);
  for (const std::int32_t material : geometry.materials) used[static_cast<std::size_t>(material)] = true;
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    const scene::Material& material = scene.materials[m];
    const bool blends = material.alpha_mode == scene::AlphaMode::kBlend;
    const bool textured = material.base_texture != scene::Material::kNoTexture;
    const bool masks = material.alpha_mode == scene::AlphaMode::kMask && textured;
    if (!used[m]) continue;
    if (!isListed(scene, material, veils)) mask_of[m] = kNowhere;
    if (mask_of[m] == kNowhere) continue;
    if (isGlass(material)) {
      mask_of[m] = maskOfGlass(material);
      continue;
    }
    if (!(masks || blends)) continue;
    const scene::Texture& texture =
        textured ? scene.textures[static_cast<std::size_t>(material.base_texture)] : white();
    mask_of[m] = maskOf(texture, material.alpha_cutoff, blends ? material.alpha : Mask::kCutOut);
  }
  for (std::uint32_t i = 0; i < geometry.triangles.size(); ++i) {
    const std::int32_t mask = mask_of[static_cast<std::size_t>(geometry.materials[i])];
    if (mask == kNowhere) continue;
    (mask != kNoMask ? masked_ : opaque_).push_back(i);
    if (mask == kNoMask) continue;
    std::array<Eigen::Vector2f, 3> texture_coordinates;
    for (std::size_t k = 0; k < 3; ++k)
      texture_coordinates[k] = geometry.texture_coordinates[geometry.triangles[i][k]];
    triangles_.push_back(masks_[static_cast<std::size_t>(mask)].place(texture_coordinates));
    triangles_.back().mask = mask;
  }
}

}  // namespace sunlit::light
