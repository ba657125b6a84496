// What makes a distribution of microfacets one, by sums over the hemisphere.
#include "light/shading/ggx.h"

#include <gtest/gtest.h>

namespace sunlit::light {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kAlphas[] = {0.05, 0.3, 0.7, 1.0};
constexpr double kCosines[] = {0.1, 0.5, 0.9, 1.0};

Vector3d eyeAt(double n_v) {
  return {-std::sqrt(1.0 - n_v * n_v), 0.0, n_v};
}

/// Sum over the normals m of the upper hemisphere of D times value(m), by squares of the sphere as small as
/// the narrowest of the distributions needs.
template <typename Value>
double sumOverNormals(const Ggx<double>& facets, const Value& value) {
  constexpr int kRings = 2000, kTurns = 500;
  double sum = 0.0;
  for (int i = 0; i < kRings; ++i) {
    // Closer to the pole, where the narrow ones are: zenith angles by the square of the step.
    const double step = (i + 0.5) / kRings;
    const double zenith = 0.5 * kPi * step * step, width = kPi * step / kRings;
    for (int k = 0; k < kTurns; ++k) {
      const double turn = 2.0 * kPi * (k + 0.5) / kTurns;
      const Vector3d normal(std::sin(zenith) * std::cos(turn), std::sin(zenith) * std::sin(turn),
                            std::cos(zenith));
      sum += facets.distribution(normal.z()) * value(normal) * std::sin(zenith) * width * 2.0 * kPi / kTurns;
    }
  }
  return sum;
}

// Walter et al. 2007, eq. 4. The sum is good to 1e-5; a wrong factor would be far off.
TEST(Ggx, FacetsTogetherCoverTheSurface) {
  for (const double alpha : kAlphas) {
    const Ggx<double> facets(alpha);
    EXPECT_NEAR(sumOverNormals(facets, [](const Vector3d& normal) { return normal.z(); }), 1.0, 1e-4);
  }
}

// Heitz 2014, eq. 16: whatever the roughness, the facets that an eye sees look as large as the surface.
TEST(Ggx, VisibleFacetsLookAsLargeAsTheSurface) {
  for (const double alpha : kAlphas) {
    for (const double n_v : kCosines) {
      const Ggx<double> facets(alpha);
      const double turned =
          sumOverNormals(facets, [&](const Vector3d& m) { return std::max(0.0, m.dot(eyeAt(n_v))); });
      EXPECT_NEAR(turned / (1.0 + facets.lambda(n_v)), n_v, 1e-4) << alpha << " " << n_v;
    }
  }
}

// G2 by two ways of writing: 1 / (1 + Λ(l) + Λ(v)), Heitz 2014, eq. 99. Equal but for rounding.
TEST(Ggx, VisibilityIsShadowingOverFourCosines) {
  for (const double alpha : kAlphas) {
    const Ggx<double> facets(alpha);
    for (const double n_v : kCosines) {
      for (const double n_l : kCosines) {
        const double both = 1.0 / (1.0 + facets.lambda(n_l) + facets.lambda(n_v));
        EXPECT_NEAR(facets.visibility(n_l, n_v) * 4.0 * n_l * n_v, both, 1e-12);
        EXPECT_NEAR(facets.shadowing(n_l, n_v) / (1.0 + facets.lambda(n_v)), both, 1e-12);
      }
    }
  }
}

// Share of the facets, by area, within a cosine: the number that this cosine is chosen by.
TEST(Ggx, NormalsAreChosenByTheAreaThatTheyCover) {
  for (const double alpha : kAlphas) {
    const Ggx<double> facets(alpha);
    for (const double random : {0.1, 0.5, 0.9}) {
      const double least = facets.normalsCosine(random);
      const double within =
          sumOverNormals(facets, [&](const Vector3d& m) { return m.z() > least ? m.z() : 0.0; });
      // One of 2000 rings more or less, of which the densest holds 0.2 %.
      EXPECT_NEAR(within, random, 2e-3) << alpha;
    }
  }
}

// Their mean, for which the sum over all normals that the eye sees is the truth.
TEST(Ggx, VisibleNormalsAreChosenAsOftenAsTheyAreSeen) {
  for (const double alpha : kAlphas) {
    for (const double n_v : kCosines) {
      const Ggx<double> facets(alpha);
      const Vector3d eye = eyeAt(n_v);
      Vector3d chosen = Vector3d::Zero(), seen = Vector3d::Zero();
      constexpr int kRadii = 300, kTurns = 300;
      for (int i = 0; i < kRadii * kTurns; ++i) {
        const double radius = std::sqrt((i % kRadii + 0.5) / kRadii);
        const double turn = 2.0 * kPi * (i / kRadii + 0.5) / kTurns;
        chosen += facets.visibleNormal(eye, {radius * std::cos(turn), radius * std::sin(turn)});
      }
      chosen /= kRadii * kTurns;
      const auto weight = [&](const Vector3d& m) {
        return std::max(0.0, m.dot(eye)) / ((1.0 + facets.lambda(n_v)) * n_v);
      };
      for (int axis = 0; axis < 3; ++axis)
        seen[axis] = sumOverNormals(facets, [&](const Vector3d& m) { return weight(m) * m[axis]; });
      // 90,000 points leave 1e-4, at grazing angles, where the disc's rim counts most, 1e-3.
      EXPECT_LT((chosen - seen).norm(), 1e-3) << alpha << " " << n_v;
    }
  }
}

// D is exact in it, and so is Smith's term where α is 1; else Hammon's slides say that it is close: the two
// limits between which it takes a mean are of smooth and rough surfaces, so for α → 0 it is exact again.
TEST(Ggx, LobeOfAViewIsTheSameWithoutRoots) {
  for (const double alpha : {1e-4, 1.0}) {
    const Ggx<double> facets(alpha);
    for (const double n_v : kCosines) {
      for (const double n_l : kCosines) {
        const Vector3d light(std::sqrt(1.0 - n_l * n_l), 0.0, n_l), half = (light + eyeAt(n_v)).normalized();
        const double v_h = half.dot(light);
        const double lobe = 8.0 * alpha * alpha / kPi * v_h * v_h * v_h * v_h /
                            GgxOfView<double>(alpha, n_v).divisor(n_l, v_h * v_h);
        const double exact = facets.distribution(half.z()) * facets.visibility(n_l, n_v);
        EXPECT_NEAR(lobe / exact, 1.0, alpha == 1.0 ? 1e-9 : 1e-2) << alpha << " " << n_v << " " << n_l;
      }
    }
  }
}

}  // namespace
}  // namespace sunlit::light
