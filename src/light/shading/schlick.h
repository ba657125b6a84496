/// Schlick 1994, eq. 15.
#pragma once

namespace sunlit::light {

/// Reflectance of a dielectric of index 1.5 at normal incidence, as glTF 2.0 fixes it.
constexpr float kDielectricF0 = 0.04f;

/// Reflectance at normal incidence of what is a metal, of a colour of that luminance, by that share.
inline float normalReflectance(float luminance, float metalness) {
  return kDielectricF0 + (luminance - kDielectricF0) * metalness;
}

/// How far the reflectance has gone from that at normal incidence to 1: (1 − cosine)⁵, cosine that of the
/// angle of incidence, 0 … 1.
inline float schlick(float cosine) {
  const float x = 1.0f - cosine;
  const float square = x * x;
  return square * square * x;
}

}  // namespace sunlit::light
