#include "droplets.h"

#include <tbb/parallel_for.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "quadrature.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::sky {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

constexpr int kDegrees = 64;         // 0.86^64 is 6e-5
constexpr int kFirstDoublings = 13;  // from a layer so thin that what is scattered twice in it does not count
constexpr float kGrazing = 1e-3F;    // the least cosine from the vertical that is told from the horizon
constexpr char kName[] = "droplets-2-g0.86";

/// Normalised associated Legendre functions of one order at one cosine, by degree.
std::vector<double> legendre(int order, double x) {
  std::vector<double> values(static_cast<std::size_t>(kDegrees), 0.0);
  double start = 1.0;
  for (int i = 1; i <= order; ++i) start *= std::sqrt((2.0 * i - 1.0) / (2.0 * i));
  double before = 0.0;
  double now = start * std::pow(std::max(0.0, 1.0 - x * x), 0.5 * order);
  for (int l = order; l < kDegrees; ++l) {
    values[static_cast<std::size_t>(l)] = now;
    const double next =
        ((2.0 * l + 1.0) * x * now - std::sqrt(static_cast<double>(l * l - order * order)) * before) /
        std::sqrt(static_cast<double>((l + 1) * (l + 1) - order * order));
    before = now;
    now = next;
  }
  return values;
}

/// One mode of the phase function between nodes on the same side and on opposite sides; its mean over all
/// directions is 1.
struct PhaseMode {
  Matrix ahead, back;
};

PhaseMode phaseMode(int mode, const std::vector<double>& cosines) {
  const auto n = static_cast<Eigen::Index>(cosines.size());
  Matrix values(n, kDegrees);
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::vector<double> row = legendre(mode, cosines[static_cast<std::size_t>(i)]);
    values.row(i) = Eigen::Map<const Eigen::RowVectorXd>(row.data(), kDegrees);
  }
  Vector strength(kDegrees), flipped(kDegrees);
  for (int l = 0; l < kDegrees; ++l) {
    strength[l] = (2.0 * l + 1.0) * std::pow(kDropletAsymmetry, l);
    flipped[l] = (l + mode) % 2 == 0 ? strength[l] : -strength[l];
  }
  return {values * strength.asDiagonal() * values.transpose(),
          values * flipped.asDiagonal() * values.transpose()};
}

/// (e^(−a) − e^(−b)) / (b − a), also for a = b.
double slope(double a, double b) {
  const double difference = std::abs(b - a);
  const double least = std::exp(-std::min(a, b));
  return difference < 1e-9 ? least : least * -std::expm1(-difference) / difference;
}

/// Of π times the luminance over μ0 times the illuminance, scattered once on the way through `depth`.
double transmittedOnce(double mu, double mu0, double depth) {
  return depth * slope(depth / mu, depth / mu0) / (4.0 * mu * mu0);
}

/// One mode of a layer: what it reflects and transmits, scattered, and what it lets pass.
struct Layer {
  Matrix reflected, transmitted;
  Vector passed;
};

Layer thinLayer(const PhaseMode& phase, const std::vector<double>& cosines, double depth) {
  const Eigen::Index n = phase.ahead.rows();
  Layer layer{Matrix(n, n), Matrix(n, n), Vector(n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const double mu = cosines[static_cast<std::size_t>(i)];
    layer.passed[i] = std::exp(-depth / mu);
    for (Eigen::Index j = 0; j < n; ++j) {
      const double mu0 = cosines[static_cast<std::size_t>(j)];
      layer.reflected(i, j) =
          phase.back(i, j) * -std::expm1(-depth * (1.0 / mu + 1.0 / mu0)) / (4.0 * (mu + mu0));
      layer.transmitted(i, j) = phase.ahead(i, j) * transmittedOnce(mu, mu0, depth);
    }
  }
  return layer;
}

/// Two of the same, one on the other: de Haan et al. 1987, eq. 84-90, for a layer that is the same from both
/// sides. `measure` is 2 μ times the weight of each node.
Layer doubled(const Layer& layer, const Vector& measure) {
  const Matrix& r = layer.reflected;
  const Matrix& t = layer.transmitted;
  const auto passed = layer.passed.asDiagonal();
  const Matrix rw = r * measure.asDiagonal();
  const Matrix tw = t * measure.asDiagonal();
  const Matrix once = rw * r;
  const Matrix between = Matrix::Identity(r.rows(), r.cols()) - once * measure.asDiagonal();
  // All that goes back and forth between the two before it goes down.
  const Matrix again = between.partialPivLu().solve(once);
  const Matrix down = t + again * passed + again * measure.asDiagonal() * t;
  const Matrix up = r * passed + rw * down;
  Layer two;
  two.reflected = r + passed * up + tw * up;
  two.transmitted = passed * down + t * passed + tw * down;
  two.passed = layer.passed.array().square();
  return two;
}

/// Weights of four neighbours of `at` among `nodes`, which rise: the cubic through them (Lagrange).
template <typename Nodes>
std::pair<std::size_t, std::array<float, 4>> cubic(const Nodes& nodes, float at) {
  const auto above = std::upper_bound(nodes.begin(), nodes.end(), at) - nodes.begin();
  const auto first = static_cast<std::size_t>(
      std::clamp<std::ptrdiff_t>(above - 2, 0, static_cast<std::ptrdiff_t>(nodes.size()) - 4));
  std::array<float, 4> weights;
  for (std::size_t i = 0; i < 4; ++i) {
    double weight = 1.0;
    for (std::size_t j = 0; j < 4; ++j) {
      if (j == i) continue;
      weight *= static_cast<double>(at - nodes[first + j]) /
                static_cast<double>(nodes[first + i] - nodes[first + j]);
    }
    weights[i] = static_cast<float>(weight);
  }
  return {first, weights};
}

}  // namespace

float dropletPhase(float cos_angle) {
  constexpr auto g = static_cast<float>(kDropletAsymmetry);
  const float root = std::sqrt(1.0F + g * g - 2.0F * g * cos_angle);
  return (1.0F - g * g) / (4.0F * static_cast<float>(kPi) * root * root * root);
}

float passedStraight(float optical_depth, float mu) {
  return std::exp(-optical_depth / std::max(mu, kGrazing));
}

float stoppedOf(float optical_depth, float mu) {
  return -std::expm1(-optical_depth / std::max(mu, kGrazing));
}

Droplets::Droplets(const TableStore& kept) {
  std::vector<double> cosines{1.0}, weights{0.0};
  for (const Node& node : gaussLegendre(kNodes - 1, 0.0, 1.0)) {
    cosines.push_back(node.x);
    weights.push_back(node.weight);
  }
  for (std::size_t i = 0; i < angles_.size(); ++i) angles_[i] = static_cast<float>(std::acos(cosines[i]));

  constexpr std::size_t kNumbers = kDepths * (kModes * kNodes + 1) * kNodes;
  if (kept.find) numbers_ = kept.find(kName);
  if (numbers_.size() == kNumbers) return;
  numbers_.assign(kNumbers, 0.0F);
  tbb::parallel_for(0, static_cast<int>(kModes), [&](int mode) { computeMode(mode, cosines, weights); });
  if (kept.keep) kept.keep(kName, numbers_);
}

void Droplets::computeMode(int mode, const std::vector<double>& cosines, const std::vector<double>& weights) {
  const PhaseMode phase = phaseMode(mode, cosines);
  Vector measure(kNodes);
  for (Eigen::Index i = 0; i < kNodes; ++i)
    measure[i] = 2.0 * cosines[static_cast<std::size_t>(i)] * weights[static_cast<std::size_t>(i)];
  const auto keep = [&](int index, double depth, const Layer& layer) {
    float* transmitted =
        numbers_.data() + static_cast<std::size_t>((index * kModes + mode) * kNodes * kNodes);
    for (Eigen::Index i = 0; i < kNodes; ++i) {
      for (Eigen::Index j = 0; j < kNodes; ++j) {
        const double once = phase.ahead(i, j) * transmittedOnce(cosines[static_cast<std::size_t>(i)],
                                                                cosines[static_cast<std::size_t>(j)], depth);
        *transmitted++ = static_cast<float>(layer.transmitted(i, j) - once);
      }
    }
    if (mode != 0) return;
    const Eigen::VectorXf reflected = (layer.reflected * measure).cast<float>();
    std::copy_n(
        reflected.data(), kNodes,
        numbers_.data() + static_cast<std::size_t>(kDepths * kModes * kNodes * kNodes + index * kNodes));
  };
  for (int half = 0; half < 2; ++half) {
    double depth = std::ldexp(half == 0 ? kLeastDepth : kLeastDepth * std::sqrt(2.0), -kFirstDoublings);
    Layer layer = thinLayer(phase, cosines, depth);
    for (int doubling = 1; doubling < kFirstDoublings + kDepths / 2; ++doubling) {
      layer = doubled(layer, measure);
      depth *= 2.0;
      if (doubling >= kFirstDoublings) keep(2 * (doubling - kFirstDoublings) + half, depth, layer);
    }
  }
}

DropletLayer::DropletLayer(const Droplets& droplets, double optical_depth)
    : depth_(static_cast<float>(optical_depth)),
      angles_(droplets.zenithAngles()),
      transmitted_(Droplets::kModes * Droplets::kNodes * Droplets::kNodes, 0.0F),
      reflected_{} {
  std::array<float, Droplets::kDepths> steps;
  for (std::size_t i = 0; i < steps.size(); ++i) steps[i] = static_cast<float>(i);
  const double step = 2.0 * std::log2(optical_depth / Droplets::kLeastDepth);
  constexpr double kLastStep = Droplets::kDepths - 1;
  auto [first, weights] = cubic(steps, static_cast<float>(std::clamp(step, 0.0, kLastStep)));
  // Of thinner layers than the thinnest: what is scattered once goes with their depth, twice with its square.
  const auto thinner = static_cast<float>(std::exp2(0.5 * std::min(0.0, step)));
  // Of thicker ones than the thickest: what comes through goes with 1 / depth, all else is thrown back.
  const auto thicker = static_cast<float>(std::exp2(-0.5 * std::max(0.0, step - kLastStep)));
  for (std::size_t k = 0; k < 4; ++k) {
    const auto depth = static_cast<int>(first + k);
    const float* transmitted = droplets.transmitted(depth, 0);
    for (float& sum : transmitted_) sum += weights[k] * thinner * thinner * thicker * *transmitted++;
    for (std::size_t i = 0; i < reflected_.size(); ++i)
      reflected_[i] += weights[k] * thinner * droplets.reflected(depth)[i];
  }
  for (float& reflected : reflected_) reflected = 1.0F - thicker * (1.0F - reflected);
  double sum = 0.0;
  for (const Node& node : gaussLegendre(Droplets::kNodes - 1, 0.0, 1.0))
    sum += 2.0 * node.x * node.weight * static_cast<double>(reflected(static_cast<float>(std::acos(node.x))));
  spherical_albedo_ = static_cast<float>(sum);
}

DropletLayer::Blend DropletLayer::between(float angle_rad) const {
  const auto [first, weights] = cubic(angles_, std::min(angle_rad, angles_.back()));
  return {first, weights};
}

float DropletLayer::amplitude(std::size_t mode, const Blend& seen, const Blend& lit) const {
  float sum = 0.0F;
  for (std::size_t i = 0; i < 4; ++i) {
    const float* row =
        transmitted_.data() + (mode * Droplets::kNodes + seen.first + i) * Droplets::kNodes + lit.first;
    for (std::size_t j = 0; j < 4; ++j) sum += seen.weights[i] * lit.weights[j] * row[j];
  }
  return sum;
}

std::array<float, Droplets::kModes> DropletLayer::modes(float seen_rad, float lit_rad) const {
  const Blend seen = between(seen_rad);
  const Blend lit = between(lit_rad);
  std::array<float, Droplets::kModes> amplitudes;
  const float scale = std::max(0.0F, std::cos(lit_rad)) / static_cast<float>(kPi);
  for (std::size_t mode = 0; mode < amplitudes.size(); ++mode)
    amplitudes[mode] = amplitude(mode, seen, lit) * scale * (mode == 0 ? 1.0F : 2.0F);
  return amplitudes;
}

float DropletLayer::evenMode(float seen_rad, float lit_rad) const {
  return amplitude(0, between(seen_rad), between(lit_rad)) * std::max(0.0F, std::cos(lit_rad)) /
         static_cast<float>(kPi);
}

DropletLayer::Once DropletLayer::once(float mu, float mu0) const {
  const double through = transmittedOnce(std::max(mu, kGrazing), std::max(mu0, kGrazing), depth_);
  return {static_cast<float>(through), mu0};
}

float DropletLayer::Once::under(float cos_angle) const {
  // The factor 4π makes of a share into 1 sr the phase function of transmittedOnce().
  return 4.0F * dropletPhase(cos_angle) * through * mu0;
}

Eigen::Array3f DropletLayer::bluing() const {
  constexpr float kOfThickCloud = 0.77F;  // albedo at an optical depth of 30
  const float part = std::min(1.0F, spherical_albedo_ / kOfThickCloud);
  return 1.0F + (kOvercastBluing - 1.0F) * part;
}

float DropletLayer::reflected(float angle_rad) const {
  const Blend seen = between(angle_rad);
  float sum = 0.0F;
  for (std::size_t i = 0; i < 4; ++i) sum += seen.weights[i] * reflected_[seen.first + i];
  return sum;
}

}  // namespace sunlit::sky
