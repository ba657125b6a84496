#include "light/picture/lamps/lit_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "light/lamps/tube.h"
#include "light/shading/direct_parts.h"
#include "light/shading/ggx.h"
#include "light/shading/schlick.h"
#include "light/shading/surface_reflection.h"
#include "sunlit/quantity/vector_clones.h"

namespace sunlit::light {
namespace {

/// Vectors and colours are three rows each.
enum Row : std::size_t {
  kPosition = 0,
  kGeometricNormal = 3,
  kNormal = 6,
  kToEye = 9,
  kF0 = 12,
  kLambert = 15,
  kThrough = 18,
  kGrazing = 21,
  kClear,
  kNormalEye,  ///< cosine between them
  kAlpha,
  kByLobe,  ///< share of its surroundings that its lobe shows; rays show the rest
  kOpaque,  ///< 1: nothing of what falls on its other side comes through, 0: of some it does
  kRowCount
};

struct Rows {
  const float* values;
  std::size_t stride;
  const float* operator[](std::size_t row) const { return values + row * stride; }
};

/// A flat source of some size: patches of it side by side, about as long as they are wide.
struct Panel {
  static constexpr std::size_t kMost = 16;
  std::array<Eigen::Vector3f, kMost> middles;
  std::size_t count;
  float soft;  ///< m²: added to squares of distances, since a patch gives less near by than its middle would
  Eigen::Vector3f normal;

  /// `patches`: 4 or 16.
  Panel(const LampBeam& beam, std::size_t patches) : count(patches), normal(beam.normal()) {
    const Eigen::Matrix<float, 3, 2> half = beam.half();
    const Eigen::Vector2f size = half.colwise().norm().transpose();
    // Half of what is right straight before a disc of that area, where it is r² / 2; far beside it none is.
    soft = std::max(size.prod() / (kPiFloat * static_cast<float>(count)), 1e-6f);
    const float aspect = size.maxCoeff() / std::max(size.minCoeff(), 1e-6f);
    std::size_t many = patches == kMost ? 4 : 2;  // along the longer side
    for (float longest = 2.0f; many < patches && aspect > longest; longest *= 4.0f) many *= 2;
    const std::size_t along = size.x() < size.y() ? count / many : many, across = count / along;
    const auto place = [](std::size_t i, std::size_t all) {
      return (2.0f * static_cast<float>(i) + 1.0f) / static_cast<float>(all) - 1.0f;
    };
    for (std::size_t i = 0; i < count; ++i)
      middles[i] =
          beam.position() + half * Eigen::Vector2f(place(i % along, along), place(i / along, across));
  }
};

/// A tube of some length.
struct Tube {
  Eigen::Vector3f middle, axis;
  float half_m, radius_m;

  explicit Tube(const LampBeam& beam)
      : middle(beam.position()),
        axis(beam.halfLength().normalized()),
        half_m(beam.halfLength().norm()),
        radius_m(beam.tubeRadius_m()) {}
};

struct Source {
  Eigen::Vector3f position;
  float shown_radius_m;
  float shown_at_least;  ///< by lobes: 1 of a lamp; 0 of a surface, which mirrors show by rays
  Eigen::Array3f intensity;
  float brightest;
  const Panel* panel;  ///< null: a point but for the lobes, or
  const Tube* tube;
};

/// Of half its diagonal: within that of a flat source all of its patches count, or four of them. Light
/// changes by less than 1 % at either.
constexpr float kClose = 4.0f, kNear = 16.0f;

/// atan(x), x ≥ 0, within 0.006.
inline __attribute__((always_inline)) float angleOf(float x) {
  const float square = x * x;
  const float narrow = x / (1.0f + 0.28f * square), wide = 0.5f * kPiFloat - x / (square + 0.28f);
  return x <= 1.0f ? narrow : wide;
}

/// How a block of surfaces sees a lamp.
struct Seen {
  alignas(64) float lx[LitRows::kBlock];  ///< on its plane for 1 cd of intensity; < 0: on its other side
  alignas(64) float x[LitRows::kBlock], y[LitRows::kBlock], z[LitRows::kBlock];  ///< unit, from there to it
  alignas(64) float per_m[LitRows::kBlock];  ///< 1 / the distance of its middle
  alignas(64) float fresnel[LitRows::kBlock], lobe[LitRows::kBlock];
};

struct Target {
  float* values;
  std::uint32_t* blocks;
};

/// Keeps what matters of the shares of a block; returns whether anything does.
inline __attribute__((always_inline)) bool choose(const float* shares, const float* least_lx, float brightest,
                                                  float* __restrict chosen) {
  int any = 0;
  for (std::size_t k = 0; k < LitRows::kBlock; ++k) {
    const bool enough = shares[k] * brightest > least_lx[k];
    chosen[k] = enough ? shares[k] : 0.0f;
    any |= enough ? 1 : 0;
  }
  return any != 0;
}

// Of what follows `rows` begin with the block's.

inline __attribute__((always_inline)) void look(const Source& lamp, const Rows& rows, const float* shares,
                                                Seen* __restrict seen) {
  const float lamp_x = lamp.position.x(), lamp_y = lamp.position.y(), lamp_z = lamp.position.z();
  for (std::size_t k = 0; k < LitRows::kBlock; ++k) {
    const auto dot = [&](std::size_t row, float x, float y, float z) {
      return rows[row][k] * x + rows[row + 1][k] * y + rows[row + 2][k] * z;
    };
    const float x = lamp_x - rows[kPosition][k], y = lamp_y - rows[kPosition + 1][k],
                z = lamp_z - rows[kPosition + 2][k];
    const float per_m = 1.0f / std::max(std::sqrt(x * x + y * y + z * z), 1e-6f);
    const bool lost = (rows[kOpaque][k] > 0.0f) & (dot(kGeometricNormal, x, y, z) <= 0.0f);
    seen->lx[k] = lost ? 0.0f : per_m * dot(kNormal, x, y, z) * shares[k];
    seen->x[k] = per_m * x;
    seen->y[k] = per_m * y;
    seen->z[k] = per_m * z;
    seen->per_m[k] = per_m;
  }
}

/// The same of all patches of a panel; the way is that of its light in sum. Where `shares` are 0: nothing.
inline __attribute__((always_inline)) void lookAtPanel(const Source& lamp, const Rows& rows,
                                                       const float* shares, Seen* __restrict seen) {
  const Panel& panel = *lamp.panel;
  constexpr std::size_t kBlock = LitRows::kBlock;
  alignas(64) float front[kBlock] = {}, behind[kBlock] = {}, sum_x[kBlock] = {}, sum_y[kBlock] = {},
                    sum_z[kBlock] = {};
  const float out_x = panel.normal.x(), out_y = panel.normal.y(), out_z = panel.normal.z();
  const float each = 1.0f / static_cast<float>(panel.count), soft = panel.soft;
  for (std::size_t i = 0; i < panel.count; ++i) {
    const float middle_x = panel.middles[i].x(), middle_y = panel.middles[i].y(),
                middle_z = panel.middles[i].z();
    for (std::size_t k = 0; k < kBlock; ++k) {
      const auto dot = [&](std::size_t row, float x, float y, float z) {
        return rows[row][k] * x + rows[row + 1][k] * y + rows[row + 2][k] * z;
      };
      const float x = middle_x - rows[kPosition][k], y = middle_y - rows[kPosition + 1][k],
                  z = middle_z - rows[kPosition + 2][k];
      const float per_square = 1.0f / (x * x + y * y + z * z + soft);
      const float before = std::max(-(x * out_x + y * out_y + z * out_z), 0.0f);
      const float light = before * per_square * per_square * each;  // and another 1 / m
      const bool lost = (rows[kOpaque][k] > 0.0f) & (dot(kGeometricNormal, x, y, z) <= 0.0f);
      const float cosine = lost ? 0.0f : dot(kNormal, x, y, z);
      front[k] += light * std::max(cosine, 0.0f);
      behind[k] += light * std::min(cosine, 0.0f);
      sum_x[k] += light * x;
      sum_y[k] += light * y;
      sum_z[k] += light * z;
    }
  }
  for (std::size_t k = 0; k < kBlock; ++k) {
    const float x = sum_x[k], y = sum_y[k], z = sum_z[k];
    const float per = 1.0f / std::max(std::sqrt(x * x + y * y + z * z), 1e-12f);
    const float lx = front[k] > 0.0f ? front[k] : behind[k];
    seen->lx[k] = shares[k] > 0.0f ? lx : 0.0f;
    seen->x[k] = per * x;
    seen->y[k] = per * y;
    seen->z[k] = per * z;
    const float way_x = lamp.position.x() - rows[kPosition][k],
                way_y = lamp.position.y() - rows[kPosition + 1][k],
                way_z = lamp.position.z() - rows[kPosition + 2][k];
    seen->per_m[k] = 1.0f / std::max(std::sqrt(way_x * way_x + way_y * way_y + way_z * way_z), 1e-6f);
  }
}

/// Part of a line, from one end to the other as numbers along it; none where the ends have changed places.
struct Stretch {
  float from, to;

  /// What lies before a plane from which the point u is `at_0` + `per_m` u away.
  __attribute__((always_inline)) Stretch before(float at_0, float per_m) const {
    const float slope = std::copysign(std::max(std::abs(per_m), 1e-12f), per_m), cut = -at_0 / slope;
    return {slope > 0.0f ? std::max(from, cut) : from, slope > 0.0f ? to : std::min(to, cut)};
  }
};

/// The same of a tube, of which the part counts that lies before a surface.
inline __attribute__((always_inline)) void lookAtTube(const Source& lamp, const Rows& rows,
                                                      const float* shares, Seen* __restrict seen) {
  const Tube& tube = *lamp.tube;
  const float middle_x = tube.middle.x(), middle_y = tube.middle.y(), middle_z = tube.middle.z();
  const float axis_x = tube.axis.x(), axis_y = tube.axis.y(), axis_z = tube.axis.z();
  const float half_m = tube.half_m, radius_m = tube.radius_m;
  for (std::size_t k = 0; k < LitRows::kBlock; ++k) {
    const auto dot = [&](std::size_t row, float x, float y, float z) {
      return rows[row][k] * x + rows[row + 1][k] * y + rows[row + 2][k] * z;
    };
    const float x = middle_x - rows[kPosition][k], y = middle_y - rows[kPosition + 1][k],
                z = middle_z - rows[kPosition + 2][k];
    const float along_m = x * axis_x + y * axis_y + z * axis_z;
    // To the nearest point of the line; from there on the tube is measured.
    const float to_x = x - along_m * axis_x, to_y = y - along_m * axis_y, to_z = z - along_m * axis_z;
    const float away_m = std::max(std::sqrt(to_x * to_x + to_y * to_y + to_z * to_z), radius_m);
    const Stretch all{along_m - half_m, along_m + half_m};
    const Stretch above =
        all.before(dot(kGeometricNormal, to_x, to_y, to_z), dot(kGeometricNormal, axis_x, axis_y, axis_z));
    const bool opaque = rows[kOpaque][k] > 0.0f;
    const Stretch open{opaque ? above.from : all.from, opaque ? above.to : all.to};
    const float normal_0 = dot(kNormal, to_x, to_y, to_z), normal_1 = dot(kNormal, axis_x, axis_y, axis_z);
    const Stretch front = open.before(normal_0, normal_1);
    const bool lit = front.to > front.from, any = open.to > open.from;
    const TubeLight light = tubeLight(away_m, lit ? front.from : open.from, lit ? front.to : open.to);
    const float across = light.across / away_m, along = light.along;
    const float sum_x = across * to_x + along * axis_x, sum_y = across * to_y + along * axis_y,
                sum_z = across * to_z + along * axis_z;
    const float per = 1.0f / std::max(std::sqrt(sum_x * sum_x + sum_y * sum_y + sum_z * sum_z), 1e-12f);
    const float lx = (across * normal_0 + along * normal_1) / (2.0f * half_m);
    seen->lx[k] = (shares[k] > 0.0f) & any ? lx : 0.0f;
    seen->x[k] = per * sum_x;
    seen->y[k] = per * sum_y;
    seen->z[k] = per * sum_z;
    seen->per_m[k] = 1.0f / std::max(std::sqrt(x * x + y * y + z * z), 1e-6f);
  }
}

/// How much of that they mirror.
inline __attribute__((always_inline)) void mirror(const Source& lamp, const Rows& rows,
                                                  Seen* __restrict seen) {
  const float radius_m = lamp.shown_radius_m, at_least = lamp.shown_at_least;
  for (std::size_t k = 0; k < LitRows::kBlock; ++k) {
    const auto dot = [&](std::size_t row) {
      return rows[row][k] * seen->x[k] + rows[row + 1][k] * seen->y[k] + rows[row + 2][k] * seen->z[k];
    };
    const float n_l = dot(kNormal), v_l = dot(kToEye), n_v = rows[kNormalEye][k];
    // The half vector is (l + v) / (2 v_h).
    const float v_h = std::sqrt(std::min(std::max(0.5f * (1.0f + v_l), 1e-6f), 1.0f));
    const float n_h = std::min(std::max((n_l + n_v) / (2.0f * v_h), 0.0f), 1.0f);
    const Ggx<float> facets(rows[kAlpha][k]);
    seen->fresnel[k] = schlick(v_h);
    seen->lobe[k] = facets.meanDistribution(n_h, v_h, angleOf(radius_m * seen->per_m[k])) *
                    facets.visibility(std::max(n_l, 0.0f), std::max(n_v, 1e-3f)) *
                    std::max(rows[kByLobe][k], at_least);
  }
}

/// What a block reflects of one channel.
struct Channel {
  const float *f0, *lambert, *through, *grazing, *clear;
  float intensity;
};

Channel channelOf(const Rows& rows, std::size_t channel, const Source& lamp) {
  return {rows[kF0 + channel],
          rows[kLambert + channel],
          rows[kThrough + channel],
          rows[kGrazing],
          rows[kClear],
          lamp.intensity[static_cast<Eigen::Index>(channel)]};
}

// The sums of directReflectance().
inline __attribute__((always_inline)) void reflectChannel(const Seen& seen, const Channel& channel,
                                                          float* __restrict luminances) {
  const float *const f0 = channel.f0, *const lambert = channel.lambert, *const through = channel.through;
  const float *const grazing = channel.grazing, *const clear = channel.clear;
  const float intensity = channel.intensity;
  for (std::size_t k = 0; k < LitRows::kBlock; ++k) {
    const float face = f0[k] + (grazing[k] - f0[k]) * seen.fresnel[k];
    const float mirrored = face + clear[k] * (2.0f * face / (1.0f + face) - face);
    const float reflectance = lambert[k] * (1.0f - mirrored) + mirrored * seen.lobe[k];
    luminances[k] = intensity * (seen.lx[k] > 0.0f ? reflectance * seen.lx[k] : through[k] * -seen.lx[k]);
  }
}

/// Sets what is said of LitRows::Reflected. `blocks` has room for all of them; returns how many are in use.
SUNLIT_WIDE_VECTOR_CLONES
std::size_t reflectAll(const Source& lamp, const Rows& rows, const LitRows::Arriving& arriving,
                       const Target& target) {
  Seen seen;
  alignas(64) float chosen[LitRows::kBlock];
  std::size_t count = 0;
  for (std::size_t begin = 0; begin < rows.stride; begin += LitRows::kBlock) {
    if (!choose(arriving.shares + begin, arriving.least_lx + begin, lamp.brightest, chosen)) continue;
    target.blocks[count++] = static_cast<std::uint32_t>(begin);
    const Rows block{rows.values + begin, rows.stride};
    if (lamp.panel)
      lookAtPanel(lamp, block, chosen, &seen);
    else if (lamp.tube)
      lookAtTube(lamp, block, chosen, &seen);
    else
      look(lamp, block, chosen, &seen);
    mirror(lamp, block, &seen);
    float* const red = target.values + begin;
    for (std::size_t channel = 0; channel < 3; ++channel)
      reflectChannel(seen, channelOf(block, channel, lamp), red + channel * rows.stride);
    const float *const green = red + rows.stride, *const blue = green + rows.stride;
    float* const largest = red + 3 * rows.stride;
    for (std::size_t k = 0; k < LitRows::kBlock; ++k)
      largest[k] = std::max(std::max(red[k], green[k]), blue[k]);
  }
  return count;
}

}  // namespace

void LitRows::set(const Tile& tile, const scene::Scene& scene, MirrorsByRays by_rays) {
  count_ = tile.surfaces.size();
  stride_ = (count_ + kBlock - 1) / kBlock * kBlock;
  rows_.assign(kRowCount * stride_, 0.0f);
  box_.setEmpty();
  for (std::size_t i = 0; i < count_; ++i) {
    const Surface& surface = tile.surfaces[i];
    box_.extend(surface.position);
    const Reflection reflection =
        reflectionOf(surface, scene.materials[static_cast<std::size_t>(surface.material)]);
    const DirectParts parts = directParts(reflection);
    const auto put = [&](std::size_t row, const auto& three) {
      for (std::size_t k = 0; k < 3; ++k)
        rows_[(row + k) * stride_ + i] = three[static_cast<Eigen::Index>(k)];
    };
    put(kPosition, surface.position);
    put(kGeometricNormal, surface.geometric_normal);
    put(kNormal, reflection.normal);
    put(kToEye, reflection.to_eye);
    put(kF0, parts.f0);
    put(kLambert, parts.lambert);
    put(kThrough, parts.through);
    rows_[kGrazing * stride_ + i] = parts.grazing;
    rows_[kClear * stride_ + i] = parts.clear;
    rows_[kNormalEye * stride_ + i] = reflection.normal.dot(reflection.to_eye);
    rows_[kAlpha * stride_ + i] = reflection.roughness * reflection.roughness;
    rows_[kByLobe * stride_ + i] =
        reflection.transmission > 0.0f ? 1.0f : 1.0f - by_rays.share(reflection.roughness);
    rows_[kOpaque * stride_ + i] = reflection.transmission > 0.0f ? 0.0f : 1.0f;
  }
}

LampBeam::Points LitRows::positions() const {
  const Rows rows{rows_.data(), stride_};
  return {rows[kPosition], rows[kPosition + 1], rows[kPosition + 2], stride_};
}

void LitRows::reflect(const LampBeam& beam, const Arriving& arriving, Reflected* reflected) const {
  std::optional<Panel> panel;
  std::optional<Tube> tube;
  const float half_m = beam.isFlat() ? beam.half().norm() : beam.halfLength().norm();
  const bool has_size = beam.isFlat() || beam.isTube();
  const float away = has_size ? box_.exteriorDistance(beam.position()) / half_m : kNear;
  if (away < kNear && beam.isFlat()) panel.emplace(beam, away < kClose ? Panel::kMost : 4);
  if (away < kNear && beam.isTube()) tube.emplace(beam);
  reflected->values.resize(4 * stride_);
  reflected->blocks.resize(stride_ / kBlock);
  const Source source{beam.position(),        beam.shownRadius_m(), beam.isSurface() ? 0.0f : 1.0f,
                      beam.intensity(),       beam.brightest(),     panel ? &*panel : nullptr,
                      tube ? &*tube : nullptr};
  reflected->blocks.resize(reflectAll(source, {rows_.data(), stride_}, arriving,
                                      {reflected->values.data(), reflected->blocks.data()}));
}

}  // namespace sunlit::light
