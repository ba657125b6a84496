#include "light/shading/reflectances.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

#include "light/shading/shading.h"
#include "sunlit/quantity/angle.h"
#include "sunlit/quantity/random.h"
#include "sunlit/scene/weathering.h"

namespace sunlit::light {
namespace {

/// Points over a triangle, as even as any number of the first of them can be and in no rhythm with what
/// repeats: the additive sequence R2 of Roberts (2018), folded at the longest edge.
template <std::size_t kCount>
std::array<Eigen::Vector3f, kCount> evenPoints() {
  constexpr double kPlastic = 1.32471795724474602596;  // p³ = p + 1
  std::array<Eigen::Vector3f, kCount> points;
  for (std::size_t i = 0; i < kCount; ++i) {
    const double n = static_cast<double>(i) + 1.0;
    double u = std::fmod(0.5 + n / kPlastic, 1.0), v = std::fmod(0.5 + n / (kPlastic * kPlastic), 1.0);
    if (u + v > 1.0) {
      u = 1.0 - u;
      v = 1.0 - v;
    }
    points[i] = Eigen::Vector3d(1.0 - u - v, u, v).cast<float>();
  }
  return points;
}

/// Points of a part, from which on in evenPoints() it takes its own: those that all show the same of what
/// repeats look at different places of it.
std::size_t firstPoint(const Reflectances::Part& part, std::size_t of) {
  std::uint64_t key = 0;
  for (const float share : {part(1, 0), part(2, 0), part(1, 1), part(2, 1)}) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &share, sizeof(bits));
    key = scrambled(key ^ bits);
  }
  return static_cast<std::size_t>(key % of);
}

/// Calls visit(point) for as many points of a part as it takes that runs over so many cells of a texture, but
/// `most` at most.
template <typename Visit>
void visitPoints(const Reflectances::Part& part, float cells, std::size_t most, const Visit& visit) {
  static const std::array<Eigen::Vector3f, 1024> points = evenPoints<1024>();
  if (cells < 1.0f) return visit(part.rowwise().mean());  // one colour, or two side by side
  const auto count = std::min(most, static_cast<std::size_t>(4.0f * std::min(cells, 1e3f)));
  const std::size_t first = firstPoint(part, points.size() - count);
  for (std::size_t i = first; i < first + count; ++i) visit(part * points[i]);
}

}  // namespace

Reflectances::Reflectances(const Geometry& geometry) : geometry_(geometry) {
  std::vector<Wanted> wanted;
  for (const scene::Material& material : geometry.scene->materials) {
    const bool opaque = material.alpha_mode == scene::AlphaMode::kOpaque;
    Textures textures;
    textures.base = numberOf({material.base_texture, 0, 0},
                             opaque ? Thumbnail::Kind::kColor : Thumbnail::Kind::kSolidColor, &wanted);
    textures.roughness = numberOf(material.roughness_map, Thumbnail::Kind::kData, &wanted);
    textures.metalness = numberOf(material.metalness_map, Thumbnail::Kind::kData, &wanted);
    textures.emission = numberOf(material.emission_map, Thumbnail::Kind::kColor, &wanted);
    of_materials_.push_back(textures);
  }
  std::vector<std::optional<Thumbnail>> made(wanted.size());
  tbb::parallel_for(std::size_t{0}, wanted.size(), [&](std::size_t i) {
    made[i].emplace(geometry.scene->textures[static_cast<std::size_t>(wanted[i].texture)], wanted[i].kind);
  });
  for (std::optional<Thumbnail>& one : made) thumbnails_.push_back(*std::move(one));
  scene::letGoOfTexels(*geometry.scene);
}

int Reflectances::numberOf(const scene::TextureUse& use, Thumbnail::Kind kind,
                           std::vector<Wanted>* wanted) const {
  if (!use.given() || !geometry_.coordinates(use.coordinates)) return Textures::kNone;
  const auto same = std::find_if(wanted->begin(), wanted->end(), [&](const Wanted& other) {
    return other.texture == use.texture && other.kind == kind;
  });
  const auto number = static_cast<int>(same - wanted->begin());
  if (same == wanted->end()) wanted->push_back({use.texture, kind});
  return number;
}

const scene::Material& Reflectances::materialOf(std::uint32_t triangle) const {
  return geometry_.scene->materials[static_cast<std::size_t>(geometry_.materials[triangle])];
}

const Reflectances::Textures& Reflectances::texturesOf(std::uint32_t triangle) const {
  return of_materials_[static_cast<std::size_t>(geometry_.materials[triangle])];
}

Reflectances::Shown Reflectances::shown(int thumbnail, const scene::TextureUse& use,
                                        std::uint32_t triangle) const {
  if (thumbnail == Textures::kNone) return {};
  Shown of{&thumbnails_[static_cast<std::size_t>(thumbnail)], use.coordinates, use.channel};
  // As by a palette, of which it shows a texel.
  if (cells(of, triangle, Part::Identity()) < 1.0f) of.grain = Thumbnail::Grain::kTexels;
  return of;
}

Reflectances::ShownPaint Reflectances::shownPaint(std::uint32_t triangle) const {
  const scene::Material& material = materialOf(triangle);
  const Textures& textures = texturesOf(triangle);
  return {shown(textures.base, {material.base_texture, 0, 0}, triangle),
          shown(textures.roughness, material.roughness_map, triangle),
          shown(textures.metalness, material.metalness_map, triangle)};
}

Paint Reflectances::at(const TriangleSide& side, const Eigen::Vector3f& barycentric) const {
  const Paint paint = dry(shownPaint(side.triangle), side.triangle, barycentric).paint;
  return geometry_.weathering ? weathered(paint, side, barycentric) : paint;
}

Paint Reflectances::mean(const TriangleSide& side, const Part& part) const {
  const std::uint32_t triangle = side.triangle;
  const ShownPaint shows = shownPaint(triangle);
  const float most = std::max({cells(shows.base, triangle, part), cells(shows.roughness, triangle, part),
                               cells(shows.metalness, triangle, part)});
  Paint sum;
  float solid = 0.0f;
  constexpr std::size_t kMost = 16;  // a sample is the mean of several parts
  visitPoints(part, most, kMost, [&](const Eigen::Vector3f& at) {
    const Dry dry = this->dry(shows, triangle, at);
    sum += dry.solid * dry.paint;
    solid += dry.solid;
  });
  const Paint paint = (1.0f / solid) * sum;
  return geometry_.weathering ? weathered(paint, side, part.rowwise().mean()) : paint;
}

Reflectances::Dry Reflectances::dry(const ShownPaint& shows, std::uint32_t triangle,
                                    const Eigen::Vector3f& barycentric) const {
  const scene::Material& material = materialOf(triangle);
  const Eigen::Array4f base = look(shows.base, triangle, barycentric);
  const auto data = [&](const Shown& of) { return look(of, triangle, barycentric)[of.channel]; };
  Eigen::Array3f albedo = Eigen::Array3f::Zero();
  for (int k = 0; k < 3; ++k)
    albedo += barycentric[k] * geometry_.colors[geometry_.triangles[triangle][static_cast<std::size_t>(k)]];
  albedo *= material.base_color.value * base.head<3>();
  albedo *= 1.0f - material.glass;  // what goes straight through is not scattered
  return {
      {albedo.max(0.0f).min(1.0f),
       std::max(material.roughness * data(shows.roughness), scene::Material::kSmoothest),
       material.metalness * data(shows.metalness), material.dielectric.value, material.dielectric_grazing},
      base[3]};
}

Paint Reflectances::weathered(const Paint& paint, const TriangleSide& side,
                              const Eigen::Vector3f& barycentric) const {
  const std::uint32_t triangle = side.triangle;
  Eigen::Vector3f position = Eigen::Vector3f::Zero();
  for (int k = 0; k < 3; ++k)
    position +=
        barycentric[k] * geometry_.positions[geometry_.triangles[triangle][static_cast<std::size_t>(k)]];
  const float sign = side.front ? 1.0f : -1.0f;
  const Eigen::Vector3f face = sign * geometry_.planes[triangle].normal;
  scene::Weathering::Look look{paint.albedo, face, paint.roughness, paint.metalness};
  constexpr float kCell_m = 1.0f;  // about what a place in the bake stands for
  geometry_.weathering->apply(
      {position, face, kCell_m},
      geometry_.scene->materials[static_cast<std::size_t>(geometry_.materials[triangle])], &look);
  return {look.albedo, look.roughness, look.metalness, paint.dielectric, paint.dielectric_grazing};
}

Eigen::Vector2f Reflectances::coordinates(std::uint32_t triangle, const Eigen::Vector3f& barycentric,
                                          int set) const {
  Eigen::Vector2f uv = Eigen::Vector2f::Zero();
  const image::ArrayView<Eigen::Vector2f>* const of_vertices = geometry_.coordinates(set);
  for (int k = 0; of_vertices && k < 3; ++k)
    uv += barycentric[k] * (*of_vertices)[geometry_.triangles[triangle][static_cast<std::size_t>(k)]];
  return uv;
}

Eigen::Array4f Reflectances::look(const Shown& of, std::uint32_t triangle,
                                  const Eigen::Vector3f& barycentric) const {
  if (!of.thumbnail) return Eigen::Array4f::Ones();
  return of.thumbnail->at(coordinates(triangle, barycentric, of.set), of.grain);
}

float Reflectances::cells(const Shown& of, std::uint32_t triangle, const Part& part) const {
  if (!of.thumbnail) return 0.0f;
  Eigen::Array2f least = Eigen::Array2f::Constant(std::numeric_limits<float>::infinity()), most = -least;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Array2f uv = coordinates(triangle, part.col(k), of.set).array();
    least = least.min(uv);
    most = most.max(uv);
  }
  return ((most - least) * of.thumbnail->size(of.grain)).maxCoeff();
}

Eigen::Array3f Reflectances::emissionAt(std::uint32_t triangle, const Eigen::Vector3f& barycentric) const {
  const scene::Material& material = materialOf(triangle);
  const Shown of = shown(texturesOf(triangle).emission, material.emission_map, triangle);
  return material.emission.value * look(of, triangle, barycentric).head<3>();
}

Eigen::Array3f Reflectances::emission(std::uint32_t triangle, const Part& part) const {
  const scene::Material& material = materialOf(triangle);
  const Shown of = shown(texturesOf(triangle).emission, material.emission_map, triangle);
  Eigen::Array3f sum = Eigen::Array3f::Zero();
  float count = 0.0f;
  constexpr std::size_t kMost = 256;
  visitPoints(part, cells(of, triangle, part), kMost, [&](const Eigen::Vector3f& at) {
    sum += look(of, triangle, at).head<3>();
    ++count;
  });
  return material.emission.value * sum / count;
}

float Paint::normalReflectance() const {
  return LinearRgb(dielectric + (albedo - dielectric) * metalness).luminance();
}

Paint& Paint::operator+=(const Paint& other) {
  albedo += other.albedo;
  roughness += other.roughness;
  metalness += other.metalness;
  dielectric += other.dielectric;
  dielectric_grazing += other.dielectric_grazing;
  return *this;
}

Paint& Paint::operator*=(float factor) {
  albedo *= factor;
  roughness *= factor;
  metalness *= factor;
  dielectric *= factor;
  dielectric_grazing *= factor;
  return *this;
}

Reflectance reflectance(const Paint& paint, float n_v) {
  Reflection reflection;
  reflection.normal = Eigen::Vector3f::UnitZ();
  reflection.to_eye = Eigen::Vector3f(std::sqrt(1.0f - n_v * n_v), 0.0f, n_v);
  reflection.albedo = paint.albedo;
  reflection.roughness = paint.roughness;
  reflection.metalness = paint.metalness;
  reflection.dielectric = paint.dielectric;
  reflection.dielectric_grazing = paint.dielectric_grazing;
  const AmbientReflectance ambient = ambientReflectance(reflection);
  return {ambient.diffuse * kPiFloat, ambient.specular};
}

Reflectance meanReflectance(const Paint& paint) {
  constexpr int kViews = 8;  // the mirrored light is within 3 %, a thousandth of what arrives
  Reflectance mean{Eigen::Array3f::Zero(), Eigen::Array3f::Zero()};
  for (int i = 0; i < kViews; ++i) {
    const float cosine = (static_cast<float>(i) + 0.5f) / kViews;
    const Reflectance seen = reflectance(paint, cosine);
    mean.diffuse += 2.0f * cosine / kViews * seen.diffuse;
    mean.mirrored += 2.0f * cosine / kViews * seen.mirrored;
  }
  return mean;
}

}  // namespace sunlit::light
