/// Colours and highlights as older formats write them, in our units.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "sunlit/quantity/photometry.h"
#include "sunlit/scene/scene.h"

namespace sunlit::scene {

/// Reflectance where a file should give a colour and does not: a photographer's grey card, about the mean of
/// outdoor scenes.
inline const LinearRgb kNeutral(0.18f, 0.18f, 0.18f);

/// Luminance of white on a display (IEC 61966-2-1): what an emission of 1 means in formats that know no
/// units.
constexpr float kDisplayWhite_cd_per_m2 = 80.0f;

/// One display-encoded channel, 0 … 1, to linear (IEC 61966-2-1).
inline float linearFromSrgb(float encoded) {
  return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

/// Colours in COLLADA, OBJ and SDF files are picked on a screen, so they are display values. Clamped to 0
/// … 1.
inline LinearRgb linearFromSrgb(const std::array<float, 3>& encoded) {
  LinearRgb linear;
  for (int i = 0; i < 3; ++i) {
    linear.value[i] = linearFromSrgb(std::clamp(encoded[static_cast<std::size_t>(i)], 0.0f, 1.0f));
  }
  return linear;
}

/// Likewise of what shines, whose colours may be brighter than a screen: by its brightest channel above 1.
inline LinearRgb linearFromBright(const std::array<float, 3>& encoded) {
  const float peak = std::max({encoded[0], encoded[1], encoded[2], 1.0f});
  LinearRgb linear = linearFromSrgb({encoded[0] / peak, encoded[1] / peak, encoded[2] / peak});
  linear.value *= peak;
  return linear;
}

/// What a colour beside a picture multiplies it by: a black one, as exporters leave it, would make the
/// picture pointless, and counts as 1.
inline LinearRgb factorBesidePicture(const LinearRgb& color) {
  return color.value.maxCoeff() > 0.0f ? color : LinearRgb(1.0f, 1.0f, 1.0f);
}

/// Perceptual roughness whose GGX lobe is about as wide as Blinn and Phong's of the exponent `shininess`, >
/// 0: α² = 2 / (n + 2) (Walter et al. 2007, section 5.2, after Beckmann), roughness = √α.
inline float roughnessOfPhong(float shininess) {
  const float alpha = std::sqrt(2.0f / (shininess + 2.0f));
  return std::clamp(std::sqrt(alpha), Material::kSmoothest, 1.0f);
}

}  // namespace sunlit::scene
