#include "light/shading/mirror_lobe.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "light/shading/ggx.h"
#include "light/shading/schlick.h"
#include "sunlit/quantity/angle.h"
#include "sunlit/scene/scene.h"

namespace sunlit::light {
namespace {

constexpr int kAcross = 24;  ///< directions that one lobe is made of, on one side, a row and column
constexpr int kSectors = 4, kHeights = 2;
static_assert(2 * kSectors * kHeights == MirrorLobe::kParts, "two sides alike");
constexpr float kSmoothest = scene::Material::kSmoothest;

struct Sample {
  Eigen::Vector3f towards;
  float plain, grazing;
  float turn = 0.0f;  ///< from the view, where it is asked for
  /// Of a dielectric.
  float weight() const { return kDielectricF0 * plain + grazing; }
};

/// Places in the half of the unit disc that every lobe is made of.
const std::vector<Eigen::Vector2f>& halfDisc() {
  static const std::vector<Eigen::Vector2f> places = [] {
    std::vector<Eigen::Vector2f> all;
    for (int i = 0; i < kAcross * kAcross; ++i) {
      const float radius = std::sqrt((static_cast<float>(i % kAcross) + 0.5f) / kAcross);
      const float turn = kPiFloat * (static_cast<float>(i / kAcross) + 0.5f) / kAcross;
      all.emplace_back(radius * std::cos(turn), radius * std::sin(turn));
    }
    return all;
  }();
  return places;
}

/// Directions to the left of the view, by the normals that the eye sees; weighed by F · G2 / G1.
std::vector<Sample> leftHalf(float roughness, float n_v) {
  const auto facets = Ggx<float>::ofRoughness(roughness);
  // The eye is behind: the view goes along x.
  const Eigen::Vector3f eye(-std::sqrt(std::max(0.0f, 1.0f - n_v * n_v)), 0.0f, n_v);
  std::vector<Sample> samples;
  for (const Eigen::Vector2f& place : halfDisc()) {
    const Eigen::Vector3f half = facets.visibleNormal(eye, place);
    const float v_h = std::clamp(eye.dot(half), 0.0f, 1.0f);
    const Eigen::Vector3f towards = (2.0f * v_h * half - eye).normalized();
    if (towards.z() <= 1e-4f) continue;
    const float weight = facets.shadowing(towards.z(), n_v) / (kAcross * kAcross);
    const float grazing = schlick(v_h);
    samples.push_back({towards, weight * (1.0f - grazing), weight * grazing});
  }
  return samples;
}

/// Where the samples from `begin` on make up `wanted`.
std::vector<Sample>::iterator upTo(std::vector<Sample>::iterator begin, std::vector<Sample>::iterator end,
                                   float wanted) {
  float sum = 0.0f;
  while (begin != end && sum < wanted) sum += (begin++)->weight();
  return begin;
}

template <typename Iterator>
float weightOf(Iterator begin, Iterator end) {
  float sum = 0.0f;
  for (; begin != end; ++begin) sum += begin->weight();
  return sum;
}

Eigen::Vector3f meanOf(std::vector<Sample>::const_iterator begin, std::vector<Sample>::const_iterator end) {
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  float weights = 0.0f;
  for (auto sample = begin; sample != end; ++sample) {
    sum += sample->towards * sample->weight();
    weights += sample->weight();
  }
  return weights > 0.0f ? Eigen::Vector3f(sum / weights) : Eigen::Vector3f(Eigen::Vector3f::UnitX());
}

MirrorLobe makeLobe(std::vector<Sample> samples) {
  for (Sample& sample : samples) sample.turn = std::abs(std::atan2(sample.towards.y(), sample.towards.x()));
  std::stable_sort(samples.begin(), samples.end(),
                   [](const Sample& a, const Sample& b) { return a.turn < b.turn; });
  MirrorLobe lobe;
  std::size_t next = 0;
  auto begin = samples.begin();
  for (int sector = 0; sector < kSectors; ++sector) {
    const auto end =
        upTo(begin, samples.end(), weightOf(begin, samples.end()) / static_cast<float>(kSectors - sector));
    std::stable_sort(begin, end,
                     [](const Sample& a, const Sample& b) { return a.towards.z() < b.towards.z(); });
    for (int height = 0; height < kHeights; ++height) {
      const auto top = upTo(begin, end, weightOf(begin, end) / static_cast<float>(kHeights - height));
      const Eigen::Vector3f left = meanOf(begin, top);
      lobe.towards[next++] = left;
      lobe.towards[next++] = Eigen::Vector3f(left.x(), -left.y(), left.z());
      begin = top;
    }
  }
  return lobe;
}

float meanGrazingOf(float n_v) {
  constexpr int kRadii = 32, kTurns = 64;
  const float sine = std::sqrt(std::max(0.0f, 1.0f - n_v * n_v));
  float sum = 0.0f;
  for (int i = 0; i < kRadii; ++i) {
    const float sine2 = (static_cast<float>(i) + 0.5f) / kRadii;
    for (int k = 0; k < kTurns; ++k) {
      const float turn = kPiFloat * (static_cast<float>(k) + 0.5f) / kTurns;
      const float cosine =
          std::sqrt(1.0f - sine2) * n_v + std::sqrt(sine2) * sine * std::cos(turn);  // between light and eye
      sum += schlick(std::sqrt(std::max(0.0f, 0.5f * (1.0f + cosine))));
    }
  }
  return sum / (kRadii * kTurns);
}

/// Values at roughnesses by rows and views by columns.
template <typename Value, int kRows, int kColumns>
struct Table {
  std::array<std::array<Value, kColumns>, kRows> at;

  static float roughness(std::size_t row) {
    return kSmoothest + (1.0f - kSmoothest) * static_cast<float>(row) / std::max(kRows - 1, 1);
  }
  static float view(std::size_t column) {
    const float root = static_cast<float>(column) / (kColumns - 1);
    return std::max(root * root, 0.001f);
  }
  template <typename Make>
  explicit Table(const Make& make) {
    for (std::size_t row = 0; row < kRows; ++row) {
      for (std::size_t column = 0; column < kColumns; ++column)
        at[row][column] = make(roughness(row), view(column));
    }
  }
};

struct Tables {
  Table<MirrorLobe, 16, 16> lobes{
      [](float roughness, float n_v) { return makeLobe(leftHalf(roughness, n_v)); }};
  Table<MirrorAlbedo, 32, 32> albedos{[](float roughness, float n_v) {
    MirrorAlbedo sum{0.0f, 0.0f};
    for (const Sample& sample : leftHalf(roughness, n_v)) {
      sum.plain += sample.plain;
      sum.grazing += sample.grazing;
    }
    return sum;
  }};
  Table<float, 1, 32> grazing{[](float, float n_v) { return meanGrazingOf(n_v); }};
};

const Tables& tables() {
  static const Tables made;
  return made;
}

/// Between which entries of an axis of `count` a value at `coordinate`, in entries, lies.
struct Place {
  std::size_t index;
  float part;
  Place(float coordinate, int count) {
    const float within = std::clamp(coordinate, 0.0f, static_cast<float>(count - 1));
    index = std::min(static_cast<std::size_t>(within), static_cast<std::size_t>(count - 2));
    part = within - static_cast<float>(index);
  }
};

Place roughnessPlace(float roughness, int count) {
  return {(roughness - kSmoothest) / (1.0f - kSmoothest) * static_cast<float>(count - 1), count};
}
Place viewPlace(float n_v, int count) {
  return {std::sqrt(std::max(n_v, 0.0f)) * static_cast<float>(count - 1), count};
}

float between(float a, float b, float part) {
  return a + part * (b - a);
}

}  // namespace

MirrorLobe mirrorLobe(float roughness, float n_v) {
  const auto& table = tables().lobes.at;
  const Place r = roughnessPlace(roughness, static_cast<int>(table.size()));
  const auto& row = table[r.part < 0.5f ? r.index : r.index + 1];
  const Place v = viewPlace(n_v, static_cast<int>(row.size()));
  const MirrorLobe &low = row[v.index], &high = row[v.index + 1];
  MirrorLobe lobe;
  for (std::size_t k = 0; k < MirrorLobe::kParts; ++k)
    lobe.towards[k] = low.towards[k] + v.part * (high.towards[k] - low.towards[k]);
  return lobe;
}

MirrorAlbedo mirrorAlbedo(float roughness, float n_v) {
  const auto& table = tables().albedos.at;
  const Place r = roughnessPlace(roughness, static_cast<int>(table.size()));
  const Place v = viewPlace(n_v, static_cast<int>(table[0].size()));
  const auto in = [&](const auto& row) {
    return MirrorAlbedo{between(row[v.index].plain, row[v.index + 1].plain, v.part),
                        between(row[v.index].grazing, row[v.index + 1].grazing, v.part)};
  };
  const MirrorAlbedo low = in(table[r.index]), high = in(table[r.index + 1]);
  return {between(low.plain, high.plain, r.part), between(low.grazing, high.grazing, r.part)};
}

float meanGrazing(float n_v) {
  const auto& row = tables().grazing.at[0];
  const Place v = viewPlace(n_v, static_cast<int>(row.size()));
  return between(row[v.index], row[v.index + 1], v.part);
}

}  // namespace sunlit::light
