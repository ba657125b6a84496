#include "light/picture/bodies/body_light.h"

namespace sunlit::light {
namespace {

/// Real spherical harmonics, Ramamoorthi & Hanrahan, "An Efficient Representation for Irradiance Environment
/// Maps" (2001), equation 3: l = 0; 1 by y, z, x; 2 by xy, yz, 3z² − 1, xz, x² − y².
std::array<float, 9> harmonics(const Eigen::Vector3f& n) {
  return {0.282095f,
          0.488603f * n.y(),
          0.488603f * n.z(),
          0.488603f * n.x(),
          1.092548f * n.x() * n.y(),
          1.092548f * n.y() * n.z(),
          0.315392f * (3.0f * n.z() * n.z() - 1.0f),
          1.092548f * n.x() * n.z(),
          0.546274f * (n.x() * n.x() - n.y() * n.y())};
}

/// What the cosine over a hemisphere does to each order, their equation 8: π, 2π/3, π/4.
constexpr std::array<float, 9> kCosine = {3.141593f, 2.094395f, 2.094395f, 2.094395f, 0.785398f,
                                          0.785398f, 0.785398f, 0.785398f, 0.785398f};

}  // namespace

std::array<Eigen::Array3f, 9> AroundLight::zeros() {
  std::array<Eigen::Array3f, 9> all;
  all.fill(Eigen::Array3f::Zero());
  return all;
}

void AroundLight::add(const Eigen::Vector3f& towards, float solid_angle, const Eigen::Array3f& luminance) {
  const std::array<float, 9> values = harmonics(towards);
  for (std::size_t i = 0; i < 9; ++i) coefficients_[i] += luminance * (solid_angle * values[i]);
}

Eigen::Array3f AroundLight::illuminance(const Eigen::Vector3f& normal) const {
  const std::array<float, 9> values = harmonics(normal);
  Eigen::Array3f sum = Eigen::Array3f::Zero();
  for (std::size_t i = 0; i < 9; ++i) sum += coefficients_[i] * (kCosine[i] * values[i]);
  return sum.max(0.0f);
}

}  // namespace sunlit::light
