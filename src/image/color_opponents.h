/// Colour spaces in which FLIP compares; equation numbers of Andersson et al. 2020.
#pragma once

#include <array>
#include <cmath>

namespace sunlit::image {

using Triple = std::array<float, 3>;

/// Linear sRGB to CIE XYZ (IEC 61966-2-1), relative to white.
inline Triple relativeXyz(const Triple& rgb) {
  return {(0.4123908f * rgb[0] + 0.3575843f * rgb[1] + 0.1804808f * rgb[2]) / 0.9504559f,
          0.2126390f * rgb[0] + 0.7151687f * rgb[1] + 0.0721923f * rgb[2],
          (0.0193308f * rgb[0] + 0.1191948f * rgb[1] + 0.9505322f * rgb[2]) / 1.0890578f};
}

inline Triple rgbOf(const Triple& relative_xyz) {
  const float x = relative_xyz[0] * 0.9504559f, y = relative_xyz[1], z = relative_xyz[2] * 1.0890578f;
  return {3.2409699f * x - 1.5373832f * y - 0.4986108f * z, -0.9692436f * x + 1.8759675f * y + 0.0415551f * z,
          0.0556301f * x - 0.2039770f * y + 1.0569715f * z};
}

/// Linear opponents: an achromatic, a red-green and a blue-yellow one (section 4.1).
inline Triple opponents(const Triple& rgb) {
  const Triple t = relativeXyz(rgb);
  return {116.0f * t[1] - 16.0f, 500.0f * (t[0] - t[1]), 200.0f * (t[1] - t[2])};
}

inline Triple rgbOfOpponents(const Triple& opponents) {
  const float y = (opponents[0] + 16.0f) / 116.0f;
  return rgbOf({y + opponents[1] / 500.0f, y, y - opponents[2] / 200.0f});
}

/// CIE L*a*b* whose chroma fades with lightness, as Hunt found (eq. 5).
inline Triple huntLab(const Triple& rgb) {
  const auto curve = [](float t) {
    constexpr float kDelta = 6.0f / 29.0f;
    return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3.0f * kDelta * kDelta) + 4.0f / 29.0f;
  };
  const Triple t = relativeXyz(rgb);
  const float fx = curve(t[0]), fy = curve(t[1]), fz = curve(t[2]);
  const float lightness = 116.0f * fy - 16.0f;
  return {lightness, 0.01f * lightness * 500.0f * (fx - fy), 0.01f * lightness * 200.0f * (fy - fz)};
}

/// Distance for large differences (Abasi et al. 2019, eq. 6).
inline float hyab(const Triple& a, const Triple& b) {
  return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

}  // namespace sunlit::image
