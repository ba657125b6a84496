#include "sunlit/image/flip.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "color_opponents.h"
#include "sunlit/quantity/angle.h"
#include "sunlit/quantity/range.h"

namespace sunlit::image {
namespace {

using Plane = Picture<float, 1>;
using Planes = std::array<Plane, 3>;

/// Weights of a filter along one axis, centre in the middle.
using Profile = std::vector<double>;

Profile gaussian(int radius, double exponent) {
  Profile profile;
  for (int i = -radius; i <= radius; ++i) profile.push_back(std::exp(-exponent * i * i));
  return profile;
}

double sumOf(const Profile& profile) {
  double sum = 0.0;
  for (const double weight : profile) sum += weight;
  return sum;
}

Profile scaled(Profile profile, double factor) {
  for (double& weight : profile) weight *= factor;
  return profile;
}

/// Positive weights sum to 1, negative ones to −1.
Profile balanced(Profile profile) {
  double positive = 0.0, negative = 0.0;
  for (const double weight : profile) (weight > 0.0 ? positive : negative) += weight;
  for (double& weight : profile) weight /= weight > 0.0 ? positive : -negative;
  return profile;
}

/// Pixels beyond the edge repeat it.
Plane filteredAlong(const Plane& plane, const Profile& profile, int step_x, int step_y) {
  const int radius = static_cast<int>(profile.size() / 2);
  Plane result(plane.width, plane.height);
  for (int y = 0; y < plane.height; ++y) {
    for (int x = 0; x < plane.width; ++x) {
      double sum = 0.0;
      for (int i = -radius; i <= radius; ++i) {
        const int at_x = std::clamp(x + i * step_x, 0, plane.width - 1);
        const int at_y = std::clamp(y + i * step_y, 0, plane.height - 1);
        sum += profile[static_cast<std::size_t>(i + radius)] * static_cast<double>(*plane.at(at_x, at_y));
      }
      *result.at(x, y) = static_cast<float>(sum);
    }
  }
  return result;
}

Plane filtered(const Plane& plane, const Profile& along_x, const Profile& along_y) {
  return filteredAlong(filteredAlong(plane, along_x, 1, 0), along_y, 0, 1);
}

/// Contrast sensitivity of one opponent as one or two Gaussians (section 4.1, table 1): a √(π/b) exp(−π²
/// x²/b), x in degrees.
struct Sensitivity {
  double a1, b1, a2, b2;
};
constexpr std::array<Sensitivity, 3> kSensitivities = {
    {{1.0, 0.0047, 0.0, 1e-5}, {1.0, 0.0053, 0.0, 1e-5}, {34.1, 0.04, 13.5, 0.025}}};

Plane asSeen(const Plane& plane, const Sensitivity& s, double pixels_per_degree) {
  const double widest = 0.04;  // of all three
  const int radius =
      static_cast<int>(std::ceil(3.0 * std::sqrt(widest / (2.0 * kPi * kPi)) * pixels_per_degree));
  const auto profile = [&](double b) {
    return gaussian(radius, kPi * kPi / (b * pixels_per_degree * pixels_per_degree));
  };
  const Profile first = profile(s.b1), second = profile(s.b2);
  const double first_sum = s.a1 * std::sqrt(kPi / s.b1) * sumOf(first) * sumOf(first);
  const double second_sum = s.a2 * std::sqrt(kPi / s.b2) * sumOf(second) * sumOf(second);
  const double share = first_sum / (first_sum + second_sum);
  const Profile unit = scaled(first, 1.0 / sumOf(first));
  Plane seen = filtered(plane, unit, unit);
  if (s.a2 == 0.0) return seen;
  const Profile other = scaled(second, 1.0 / sumOf(second));
  const Plane more = filtered(plane, other, other);
  for (std::size_t i = 0; i < seen.data.size(); ++i) {
    seen.data[i] = static_cast<float>(share * static_cast<double>(seen.data[i]) +
                                      (1.0 - share) * static_cast<double>(more.data[i]));
  }
  return seen;
}

Planes opponentsOf(const LinearImage& picture) {
  Planes planes;
  planes.fill(Plane(picture.width, picture.height));
  for (std::size_t i = 0; i < planes[0].data.size(); ++i) {
    Triple rgb;
    for (std::size_t c = 0; c < 3; ++c) {
      const float value = picture.data[3 * i + c];
      rgb[c] = value > 0.0f ? std::min(value, 1.0f) : 0.0f;
    }
    const Triple values = opponents(rgb);
    for (std::size_t c = 0; c < 3; ++c) planes[c].data[i] = values[c];
  }
  return planes;
}

/// Difference of colour, 0 … 1 (section 4.1 to 4.3).
Plane colorDifference(const Planes& reference, const Planes& test, double pixels_per_degree) {
  constexpr float kExponent = 0.7f, kKnee = 0.4f, kKneeValue = 0.95f;
  static const float largest =
      std::pow(hyab(huntLab({0.0f, 1.0f, 0.0f}), huntLab({0.0f, 0.0f, 1.0f})), kExponent);
  Planes seen_reference, seen_test;
  for (std::size_t c = 0; c < 3; ++c) {
    seen_reference[c] = asSeen(reference[c], kSensitivities[c], pixels_per_degree);
    seen_test[c] = asSeen(test[c], kSensitivities[c], pixels_per_degree);
  }
  const auto lab = [](const Planes& seen, std::size_t i) {
    Triple rgb = rgbOfOpponents({seen[0].data[i], seen[1].data[i], seen[2].data[i]});
    for (float& value : rgb) value = std::clamp(value, 0.0f, 1.0f);
    return huntLab(rgb);
  };
  Plane result(reference[0].width, reference[0].height);
  for (std::size_t i = 0; i < result.data.size(); ++i) {
    const float difference = std::pow(hyab(lab(seen_reference, i), lab(seen_test, i)), kExponent);
    const float knee = kKnee * largest;
    result.data[i] =
        difference < knee
            ? kKneeValue * difference / knee
            : std::min(1.0f, kKneeValue + (1.0f - kKneeValue) * (difference - knee) / (largest - knee));
  }
  return result;
}

/// How strong edges and points are at each pixel (section 4.4).
struct Features {
  Plane edges, points;
};

Features featuresOf(const Plane& achromatic, double pixels_per_degree) {
  const double deviation = 0.5 * 0.082 * pixels_per_degree;
  const int radius = static_cast<int>(std::ceil(3.0 * deviation));
  const Profile bell = gaussian(radius, 0.5 / (deviation * deviation));
  Profile slope = bell, curvature = bell;
  for (int i = -radius; i <= radius; ++i) {
    const auto at = static_cast<std::size_t>(i + radius);
    slope[at] *= -i;
    curvature[at] *= i * i / (deviation * deviation) - 1.0;
  }
  const Profile smooth = scaled(bell, 1.0 / sumOf(bell));
  const auto strength = [&](const Profile& profile) {
    Plane across = filtered(achromatic, profile, smooth);
    const Plane down = filtered(achromatic, smooth, profile);
    for (std::size_t i = 0; i < across.data.size(); ++i)
      across.data[i] = std::hypot(across.data[i], down.data[i]);
    return across;
  };
  return {strength(balanced(slope)), strength(balanced(curvature))};
}

Plane normalizedAchromatic(const Plane& opponent) {
  Plane plane = opponent;
  for (float& value : plane.data) value = (value + 16.0f) / 116.0f;
  return plane;
}

void requireComparable(const LinearImage& reference, const LinearImage& test, const FlipOptions& options) {
  if (reference.width != test.width || reference.height != test.height || reference.data.empty())
    throw std::invalid_argument("flip: the pictures are empty or differ in size");
  require("pixels_per_degree", options.pixels_per_degree, {10.0, 200.0});
}

/// Narkowicz, "ACES Filmic Tone Mapping Curve" (2015), exposed 0.6 times, as Andersson et al. 2021 use it:
/// (a x² + b x) / (c x² + d x + e).
constexpr double kA = 0.36 * 2.51, kB = 0.6 * 0.03, kC = 0.36 * 2.43, kD = 0.6 * 0.59, kE = 0.14;

LinearImage toned(const LinearImage& picture, double exposure) {
  LinearImage result(picture.width, picture.height);
  const double factor = std::exp2(exposure);
  for (std::size_t i = 0; i < picture.data.size(); ++i) {
    const double value = static_cast<double>(picture.data[i]);
    const double x = value > 0.0 ? std::min(factor * value, 1e9) : 0.0;
    result.data[i] =
        static_cast<float>(std::clamp((kA * x * x + kB * x) / (kC * x * x + kD * x + kE), 0.0, 1.0));
  }
  return result;
}

/// Exposures, in powers of two, that bring the brightest pixel and the median to the top of the curve's
/// useful range, 0.85 (section 19.3).
std::pair<double, double> exposuresOf(const LinearImage& reference) {
  constexpr double kTop = 0.85;
  const double a = kA - kTop * kC, b = kB - kTop * kD, c = -kTop * kE;
  const double top = (-b + std::sqrt(b * b - 4.0 * a * c)) / (2.0 * a);
  std::vector<double> luminances;
  for (std::size_t i = 0; i < reference.data.size(); i += 3) {
    const double y = 0.2126 * static_cast<double>(reference.data[i]) +
                     0.7152 * static_cast<double>(reference.data[i + 1]) +
                     0.0722 * static_cast<double>(reference.data[i + 2]);
    luminances.push_back(std::isfinite(y) && y > 0.0 ? y : 0.0);
  }
  std::sort(luminances.begin(), luminances.end());
  const double brightest = luminances.back();
  if (!(brightest > 0.0)) return {0.0, 0.0};
  // A picture more than half black has no median to expose for.
  const double median = std::max(luminances[luminances.size() / 2], brightest * 1e-9);
  return {std::log2(top / brightest), std::log2(top / median)};
}

}  // namespace

Picture<float, 1> flip(const LinearImage& reference, const LinearImage& test, const FlipOptions& options) {
  requireComparable(reference, test, options);
  const Planes a = opponentsOf(reference), b = opponentsOf(test);
  Plane result = colorDifference(a, b, options.pixels_per_degree);
  const Features in_reference = featuresOf(normalizedAchromatic(a[0]), options.pixels_per_degree);
  const Features in_test = featuresOf(normalizedAchromatic(b[0]), options.pixels_per_degree);
  for (std::size_t i = 0; i < result.data.size(); ++i) {
    const float strongest = std::max(std::abs(in_reference.edges.data[i] - in_test.edges.data[i]),
                                     std::abs(in_reference.points.data[i] - in_test.points.data[i]));
    const float feature = std::sqrt(std::min(1.0f, strongest / std::sqrt(2.0f)));
    result.data[i] = std::pow(result.data[i], 1.0f - feature);  // section 4.5
  }
  return result;
}

Picture<float, 1> hdrFlip(const LinearImage& reference, const LinearImage& test, const FlipOptions& options) {
  requireComparable(reference, test, options);
  const auto [first, last] = exposuresOf(reference);
  const int count = std::max(2, static_cast<int>(std::ceil(last - first)));
  Plane result(reference.width, reference.height);
  for (int i = 0; i < count; ++i) {
    const double exposure = first + (last - first) * i / (count - 1);
    const Plane one = flip(toned(reference, exposure), toned(test, exposure), options);
    for (std::size_t p = 0; p < result.data.size(); ++p)
      result.data[p] = std::max(result.data[p], one.data[p]);
  }
  return result;
}

double meanOf(const Picture<float, 1>& differences) {
  double sum = 0.0;
  for (const float difference : differences.data) sum += static_cast<double>(difference);
  return differences.data.empty() ? 0.0 : sum / static_cast<double>(differences.data.size());
}

}  // namespace sunlit::image
