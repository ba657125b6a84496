#include "sunlit/scene/weathering.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "scene/noise.h"
#include "scene/top_heights.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::scene {
namespace {

/// Share of its pores that a surface has open to water: none of leaves and metal, all of what is rough.
float porosity(const Material& material, const Weathering::Look& look) {
  if (material.transmission > 0.0f) return 0.0f;
  return smoothStep(0.3f, 0.7f, look.roughness) * (1.0f - look.metalness);
}

Eigen::Array3f soaked(const Eigen::Array3f& albedo) {
  constexpr float kInner = Weathering::kInnerReflectance;
  return albedo * (1.0f - kInner) / (1.0f - kInner * albedo);
}

float mixed(float from, float to, float share) {
  return from + share * (to - from);
}

}  // namespace

void validate(const SurfaceState& state) {
  requireFields(state);
}

bool isDry(const SurfaceState& state) {
  return state.wet == 0.0 && state.puddles == 0.0 && state.snow_m == 0.0;
}

bool operator==(const SurfaceState& a, const SurfaceState& b) {
  if (isDry(a) && isDry(b)) return true;
  const bool patchy = a.puddles > 0.0 || a.snow_m > 0.0;
  return a.wet == b.wet && a.puddles == b.puddles && a.snow_m == b.snow_m && (!patchy || a.seed == b.seed);
}

Weathering::Patches::Patches(float wavelength, std::uint32_t of, double wanted)
    : wavelength_m(wavelength), seed(of), share(static_cast<float>(wanted)) {
  if (!(share > 0.0f)) return;
  // The share that is asked for lies below the threshold: by the noise itself at places far apart.
  constexpr int kSide = 128;
  std::vector<float> values;
  for (int i = 0; i < kSide * kSide; ++i)
    values.push_back(noise(0.619f * wavelength * static_cast<float>(i % kSide),
                           0.619f * wavelength * static_cast<float>(i / kSide)));
  divide(std::move(values));
}

void Weathering::Patches::divide(std::vector<float> values) {
  const auto below =
      std::min(values.size() - 1, static_cast<std::size_t>(share * static_cast<float>(values.size())));
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(below), values.end());
  threshold = values[below];
}

float Weathering::Patches::noise(float x, float y) const {
  constexpr int kOctaves = 4;
  return fractal(x / wavelength_m, y / wavelength_m, kOctaves, seed);
}

float Weathering::Patches::cover(float x, float y, float width_m, float lift) const {
  if (!(share > 0.0f)) return 0.0f;
  // Seen from so far that patches run together, there is but their share.
  const float together = smoothStep(0.25f * wavelength_m, wavelength_m, width_m);
  if (together >= 1.0f) return share;
  const float edge = 0.04f + width_m / wavelength_m;
  const float sharp = std::clamp(0.5f + (threshold - noise(x, y) - lift) / edge, 0.0f, 1.0f);
  return mixed(sharp, share, together);
}

Weathering::Weathering(const Shape& shape, const std::vector<Material>& materials, const SurfaceState& state)
    : state_(state), tops_(std::make_shared<const TopHeights>(shape, materials)) {
  validate(state);
  constexpr float kPuddle_m = 3.0f, kSnow_m = 1.2f;
  constexpr double kRoughGround_m = 0.01;
  const auto seed = static_cast<std::uint32_t>(state.seed);
  puddles_ = Patches(kPuddle_m, mix(seed, 1), state.puddles);
  if (state.puddles > 0.0) floodHollows();
  // What stands above the threshold still shows at 10 cm: one part in 3000.
  snow_ = Patches(kSnow_m, mix(seed, 2), std::tanh(state.snow_m / (2.5 * kRoughGround_m)));
}

void Weathering::floodHollows() {
  // Worlds without so many level cells have the share that chance gives them.
  constexpr std::size_t kEnough = 1024;
  constexpr int kAcross = 256;
  relief_ = tops_->relief();
  const float steepest = std::tan(5.5f * static_cast<float>(kRadPerDeg));  // half of the water stands there
  const auto isLevel = [&](int column, int row) {
    const float most = 2.0f * tops_->cell_m() * steepest;
    const float across = tops_->at(column + 1, row) - tops_->at(column - 1, row);
    const float along = tops_->at(column, row + 1) - tops_->at(column, row - 1);
    return tops_->at(column, row) != TopHeights::kNothing && across * across + along * along < most * most;
  };
  std::vector<float> values;
  const int column_step = 1 + tops_->columns() / kAcross, row_step = 1 + tops_->rows() / kAcross;
  for (int row = 0; row < tops_->rows(); row += row_step) {
    for (int column = 0; column < tops_->columns(); column += column_step) {
      if (!isLevel(column, row)) continue;
      const Eigen::Vector2f middle = tops_->middle(column, row);
      values.push_back(puddles_.noise(middle.x(), middle.y()) + lift(middle));
    }
  }
  if (values.size() >= kEnough) puddles_.divide(std::move(values));
}

float Weathering::lift(const Eigen::Vector2f& place) const {
  // Unevenness that noise of 1 stands for: of roads 4 mm are allowed under a straightedge of 4 m, and this
  // noise has a standard deviation of 0.3 or so. More than twice that counts no more, or puddles would have
  // the straight edges that the triangles of the land have.
  constexpr float kRough_m = 0.01f, kMost = 0.6f;
  if (tops_->empty()) return 0.0f;
  const TopHeights::Cell cell = tops_->cellAt(place);
  const auto at = [&](int right, int up) {
    const int column = std::clamp(cell.column + right, 0, tops_->columns() - 1);
    const int row = std::clamp(cell.row + up, 0, tops_->rows() - 1);
    return static_cast<float>(relief_[tops_->index(column, row)]);
  };
  const float steps =
      mixed(mixed(at(0, 0), at(1, 0), cell.right), mixed(at(0, 1), at(1, 1), cell.right), cell.up);
  const float lift = steps * (TopHeights::kReliefReach_m / 127.0f) / kRough_m;
  return kMost * std::tanh(lift / kMost);
}

float Weathering::open(const Place& place) const {
  if (tops_->empty()) return 1.0f;
  // Before a wall, not in it; and a slope does not shelter itself.
  constexpr float kBefore = 0.75f, kSteepest = 3.0f;
  const float across = place.face.head<2>().norm();
  const float slope = std::min(across / std::max(std::abs(place.face.z()), 1e-3f), kSteepest);
  const Eigen::Vector2f at = place.position.head<2>() + kBefore * tops_->cell_m() *
                                                            (across > 1e-3f ? 1.0f : 0.0f) *
                                                            place.face.head<2>();
  const float least = place.position.z() + TopHeights::kSlack_m + tops_->cell_m() * slope;
  const auto [column, row, right, up] = tops_->cellAt(at);
  const auto isOpen = [&, column = column, row = row](int beside, int beyond) {
    return tops_->at(column + beside, row + beyond) <= least ? 1.0f : 0.0f;
  };
  return mixed(mixed(isOpen(0, 0), isOpen(1, 0), right), mixed(isOpen(0, 1), isOpen(1, 1), right), up);
}

/// How snow as the wind left it leans, by its slope.
Eigen::Vector3f Weathering::drifts(const Place& place) const {
  constexpr float kWavelength_m = 0.9f, kHeight_m = 0.02f, kStep_m = 0.02f;
  const float seen = kHeight_m * (1.0f - smoothStep(0.1f, kWavelength_m, place.footprint_m));
  if (!(seen > 0.0f)) return Eigen::Vector3f::Zero();
  const auto height = [&](float right, float up) {
    return fractal((place.position.x() + right) / kWavelength_m, (place.position.y() + up) / kWavelength_m, 3,
                   snow_.seed);
  };
  const float here = height(0.0f, 0.0f), slope = seen / kStep_m;
  return {slope * (here - height(kStep_m, 0.0f)), slope * (here - height(0.0f, kStep_m)), 0.0f};
}

void Weathering::wet(float film, float standing, const Material& material, Look* look) const {
  // A film follows the ground below it, standing water does not.
  constexpr float kFilmGloss = 0.4f, kWaterRoughness = 0.04f;
  look->albedo = look->albedo + film * porosity(material, *look) * (soaked(look->albedo) - look->albedo);
  look->roughness = std::max(Material::kSmoothest, look->roughness * mixed(1.0f, kFilmGloss, film));
  look->roughness = mixed(look->roughness, kWaterRoughness, standing);
  look->film = film * (1.0f - look->metalness);
  if (standing > 0.0f)
    look->normal = (look->normal + standing * (Eigen::Vector3f::UnitZ() - look->normal)).normalized();
}

void Weathering::apply(const Place& place, const Material& material, Look* look) const {
  if (material.glass > 0.0f) return;
  const float up = place.face.z();
  if (!(up > -0.5f)) return;
  const float open_share = open(place);
  if (!(open_share > 0.0f)) return;
  const float x = place.position.x(), y = place.position.y();
  // 3° and 8° from level.
  const float level = material.transmission > 0.0f ? 0.0f : smoothStep(0.9903f, 0.9986f, up);
  const float standing = level > 0.0f && puddles_.share > 0.0f
                             ? open_share * level * puddles_.cover(x, y, place.footprint_m, lift({x, y}))
                             : 0.0f;
  const float faces = std::min(up + 0.5f, 1.0f);
  // Water stands on leaves in drops.
  const float takes = material.transmission > 0.0f ? 0.0f : 1.0f;
  const float film = std::max(standing, takes * static_cast<float>(state_.wet) * open_share * faces);
  if (film > 0.0f) wet(film, standing, material, look);
  const float flat = smoothStep(0.5f, 0.766f, up);  // 60° and 40°
  const float snow = open_share * flat * snow_.cover(x, y, place.footprint_m);
  if (!(snow > 0.0f)) return;
  look->normal = (look->normal + snow * drifts(place)).normalized();
  look->albedo += snow * (kSnowAlbedo - look->albedo);
  look->roughness = mixed(look->roughness, 1.0f, snow);
  look->metalness *= 1.0f - snow;
  look->film *= 1.0f - snow;
}

}  // namespace sunlit::scene
