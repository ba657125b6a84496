#include "scene/clear_coat.h"

#include <algorithm>
#include <cmath>

namespace sunlit::scene {
namespace {

constexpr float kOfCoat = 0.04f;  ///< reflectance at normal incidence, of an index of 1.5

/// Reflectance of what is beneath, at normal incidence, as far as factors tell.
float beneath(const ClearCoat& coat, const Material& material) {
  const float uncoated = (1.0f - coat.factor) * material.dielectric.luminance();
  return uncoated + material.metalness * (material.base_color.luminance() - uncoated);
}

float unit(float value) {
  return std::fmin(std::fmax(value, 0.0f), 1.0f);
}

}  // namespace

bool addClearCoat(const ClearCoat& told, Material* material) {
  const ClearCoat coat{unit(told.factor), unit(told.roughness)};
  if (!(coat.factor > 0.0f)) return true;
  const float mirrored = coat.factor * kOfCoat;
  if (!(mirrored > beneath(coat, *material))) return false;
  // Dark metal has no colour but what little it mirrors, which a diffuse one comes near.
  material->metalness = 0.0f;
  material->metalness_map = material->roughness_map = TextureUse();
  material->roughness = std::max(coat.roughness, Material::kSmoothest);
  material->dielectric.value = material->dielectric.value.max(mirrored);
  material->dielectric_grazing = std::max(material->dielectric_grazing, coat.factor);
  return true;
}

}  // namespace sunlit::scene
