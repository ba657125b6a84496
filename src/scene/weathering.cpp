#include "sunlit/scene/weathering.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "scene/noise.h"

namespace sunlit::scene {
namespace {

/// Cells of the grid along its longer side, at most.
constexpr float kMostCells = 4096.0f;
/// Wider worlds have a margin whose places all count as open.
constexpr float kWidest_m = 4096.0f;
constexpr float kNothing = -1e9f;

/// Whether rain stops there.
bool shelters(const Material& material) {
  return material.alpha_mode == AlphaMode::kOpaque && !(material.transmission > 0.0f);
}

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

float Weathering::Tops::at(int column, int row) const {
  if (column < 0 || row < 0 || column >= columns || row >= rows) return kNothing;
  return height_m[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                  static_cast<std::size_t>(column)];
}

void Weathering::Tops::add(const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& c) {
  const Eigen::Vector2f u = (b - a).head<2>(), v = (c - a).head<2>();
  const float area = u.x() * v.y() - u.y() * v.x();
  if (!(std::abs(area) > 1e-9f)) return;
  const auto cellOf = [&](float low, float coordinate, int count) {
    return std::clamp(static_cast<int>(std::floor((coordinate - low) / cell_m)), 0, count - 1);
  };
  const int left = cellOf(origin.x(), std::min({a.x(), b.x(), c.x()}), columns);
  const int right = cellOf(origin.x(), std::max({a.x(), b.x(), c.x()}), columns);
  const int low = cellOf(origin.y(), std::min({a.y(), b.y(), c.y()}), rows);
  const int high = cellOf(origin.y(), std::max({a.y(), b.y(), c.y()}), rows);
  for (int row = low; row <= high; ++row) {
    for (int column = left; column <= right; ++column) {
      const Eigen::Vector2f middle = origin + cell_m * Eigen::Vector2f(static_cast<float>(column) + 0.5f,
                                                                       static_cast<float>(row) + 0.5f);
      const Eigen::Vector2f to = middle - a.head<2>();
      const float s = (to.x() * v.y() - to.y() * v.x()) / area, t = (u.x() * to.y() - u.y() * to.x()) / area;
      if (s < 0.0f || t < 0.0f || s + t > 1.0f) continue;
      float& top = height_m[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                            static_cast<std::size_t>(column)];
      top = std::max(top, a.z() + s * (b.z() - a.z()) + t * (c.z() - a.z()));
    }
  }
}

Weathering::Tops Weathering::topsOf(const Scene& scene) {
  Eigen::Array2f low = Eigen::Array2f::Constant(1e9f), high = -low;
  for (const Mesh& mesh : scene.meshes) {
    if (!shelters(scene.materials[static_cast<std::size_t>(mesh.material)])) continue;
    for (const Eigen::Vector3f& position : mesh.positions) {
      low = low.min(position.head<2>().array());
      high = high.max(position.head<2>().array());
    }
  }
  Tops tops;
  if ((low > high).any()) return tops;
  const Eigen::Array2f middle = 0.5f * (low + high);
  low = low.max(middle - 0.5f * kWidest_m);
  high = high.min(middle + 0.5f * kWidest_m);
  tops.origin = low.matrix();
  tops.cell_m = std::max(tops.cell_m, (high - low).maxCoeff() / kMostCells);
  tops.columns = static_cast<int>((high - low).x() / tops.cell_m) + 1;
  tops.rows = static_cast<int>((high - low).y() / tops.cell_m) + 1;
  tops.height_m.assign(static_cast<std::size_t>(tops.columns) * static_cast<std::size_t>(tops.rows),
                       kNothing);
  for (const Mesh& mesh : scene.meshes) {
    if (!shelters(scene.materials[static_cast<std::size_t>(mesh.material)])) continue;
    for (const auto& [a, b, c] : mesh.triangles)
      tops.add(mesh.positions[a], mesh.positions[b], mesh.positions[c]);
  }
  return tops;
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
  const auto below =
      std::min(values.size() - 1, static_cast<std::size_t>(wanted * static_cast<double>(values.size())));
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(below), values.end());
  threshold = values[below];
}

float Weathering::Patches::noise(float x, float y) const {
  constexpr int kOctaves = 4;
  return fractal(x / wavelength_m, y / wavelength_m, kOctaves, seed);
}

float Weathering::Patches::cover(float x, float y, float width_m) const {
  if (!(share > 0.0f)) return 0.0f;
  // Seen from so far that patches run together, there is but their share.
  const float together = smoothStep(0.25f * wavelength_m, wavelength_m, width_m);
  if (together >= 1.0f) return share;
  const float edge = 0.04f + width_m / wavelength_m;
  const float sharp = std::clamp(0.5f + (threshold - noise(x, y)) / edge, 0.0f, 1.0f);
  return mixed(sharp, share, together);
}

Weathering::Weathering(const Scene& scene, const SurfaceState& state) : state_(state), tops_(topsOf(scene)) {
  validate(state);
  constexpr float kPuddle_m = 3.0f, kSnow_m = 1.2f;
  constexpr double kRoughGround_m = 0.01;
  const auto seed = static_cast<std::uint32_t>(state.seed);
  puddles_ = Patches(kPuddle_m, mix(seed, 1), state.puddles);
  // What stands above the threshold still shows at 10 cm: one part in 3000.
  snow_ = Patches(kSnow_m, mix(seed, 2), std::tanh(state.snow_m / (2.5 * kRoughGround_m)));
}

float Weathering::open(const Place& place) const {
  if (tops_.columns == 0) return 1.0f;
  // Before a wall, not in it; and a slope does not shelter itself.
  constexpr float kBefore = 0.75f, kSlack_m = 0.15f, kSteepest = 3.0f;
  const float across = place.face.head<2>().norm();
  const float slope = std::min(across / std::max(std::abs(place.face.z()), 1e-3f), kSteepest);
  const Eigen::Vector2f at = place.position.head<2>() +
                             kBefore * tops_.cell_m * (across > 1e-3f ? 1.0f : 0.0f) * place.face.head<2>();
  const float least = place.position.z() + kSlack_m + tops_.cell_m * slope;
  const Eigen::Vector2f cell = (at - tops_.origin) / tops_.cell_m - Eigen::Vector2f::Constant(0.5f);
  const int column = static_cast<int>(std::floor(cell.x())), row = static_cast<int>(std::floor(cell.y()));
  const float right = cell.x() - static_cast<float>(column), up = cell.y() - static_cast<float>(row);
  const auto isOpen = [&](int c, int r) { return tops_.at(c, r) <= least ? 1.0f : 0.0f; };
  return mixed(mixed(isOpen(column, row), isOpen(column + 1, row), right),
               mixed(isOpen(column, row + 1), isOpen(column + 1, row + 1), right), up);
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
  const float standing = open_share * level * puddles_.cover(x, y, place.footprint_m);
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
