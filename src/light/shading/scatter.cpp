#include "light/shading/scatter.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "light/shading/ggx.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::light {
namespace {

/// Unit vectors that make a right-handed frame with `normal`.
struct Frame {
  Eigen::Vector3f x, y, z;
  explicit Frame(const Eigen::Vector3f& normal) : z(normal) {
    const Eigen::Vector3f aside =
        std::abs(z.z()) < 0.9f ? Eigen::Vector3f::UnitZ() : Eigen::Vector3f::UnitX();
    x = aside.cross(z).normalized();
    y = z.cross(x);
  }
  Eigen::Vector3f at(float sine, float cosine, float turn) const {
    const float angle = 2.0f * kPiFloat * turn;
    return (x * (sine * std::cos(angle)) + y * (sine * std::sin(angle)) + z * cosine).normalized();
  }
};

/// Shares of the three lobes; their sum is 1.
struct Lobes {
  float diffuse, through, mirror;
};

Lobes lobesOf(const Reflection& r) {
  const AmbientReflectance a = ambientReflectance(r);
  const float diffuse = kPiFloat * a.diffuse.maxCoeff();
  const float through = kPiFloat * a.through.maxCoeff();
  const float lambert = diffuse + through;
  // Neither is left to chance: the lobe's fit is no exact measure.
  const float mirror =
      std::clamp(a.specular.maxCoeff() / (a.specular.maxCoeff() + lambert + 1e-6f), 0.1f, 0.9f);
  if (lambert <= 0.0f) return {1.0f - mirror, 0.0f, mirror};
  return {(1.0f - mirror) * diffuse / lambert, (1.0f - mirror) * through / lambert, mirror};
}

/// Empty for a random number without use.
std::optional<Eigen::Vector3f> choose(const Reflection& r, const Lobes& lobes,
                                      const std::array<float, 3>& random) {
  const Frame frame(r.normal);
  const float sine = std::sqrt(random[1]), cosine = std::sqrt(1.0f - random[1]);
  if (random[0] < lobes.diffuse) return frame.at(sine, cosine, random[2]);
  if (random[0] < lobes.diffuse + lobes.through) return frame.at(sine, -cosine, random[2]);
  const float n_h = Ggx<float>::ofRoughness(r.roughness).normalsCosine(random[1]);
  const Eigen::Vector3f half = frame.at(std::sqrt(std::max(0.0f, 1.0f - n_h * n_h)), n_h, random[2]);
  if (half.dot(r.to_eye) <= 0.0f) return std::nullopt;  // a facet that the eye does not see
  return mirrored(r.to_eye, half).normalized();
}

float density(const Reflection& r, const Lobes& lobes, const Eigen::Vector3f& towards) {
  const float n_l = r.normal.dot(towards);
  const float lambert = (n_l > 0.0f ? lobes.diffuse * n_l : lobes.through * -n_l) / kPiFloat;
  const Eigen::Vector3f half = (towards + r.to_eye).normalized();
  const float n_h = r.normal.dot(half), v_h = r.to_eye.dot(half);
  if (!(n_h > 0.0f && v_h > 0.0f)) return lambert;
  return lambert + lobes.mirror * Ggx<float>::ofRoughness(r.roughness).mirroredDensity(n_h, v_h);
}

}  // namespace

Scattered scatter(const Reflection& reflection, const std::array<float, 3>& random) {
  const Lobes lobes = lobesOf(reflection);
  const std::optional<Eigen::Vector3f> towards = choose(reflection, lobes, random);
  if (!towards) return {reflection.normal, Eigen::Array3f::Zero(), 0.0f};
  return {*towards, directReflectance(reflection, *towards, 0.0f), density(reflection, lobes, *towards)};
}

float scatterDensity(const Reflection& reflection, const Eigen::Vector3f& towards) {
  return density(reflection, lobesOf(reflection), towards);
}

}  // namespace sunlit::light
