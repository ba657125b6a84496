#include "sunlit/scene/scene_bytes.h"

#include <cstdint>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace sunlit::scene {
namespace {

// All members, in order: structured bindings compile only as long as none is forgotten.

template <typename T, typename As>
using IfIs = std::enable_if_t<std::is_same_v<std::remove_const_t<T>, As>>;

template <typename T, IfIs<T, LinearRgb>* = nullptr>
auto partsOf(T& rgb) {
  auto& [value] = rgb;
  return std::tie(value);
}

template <typename T, IfIs<T, Texture>* = nullptr>
auto partsOf(T& texture) {
  auto& [name, width, height, rgba, wrap_u, wrap_v] = texture;
  return std::tie(name, width, height, rgba, wrap_u, wrap_v);
}

template <typename T, IfIs<T, TextureUse>* = nullptr>
auto partsOf(T& use) {
  auto& [texture, coordinates, channel] = use;
  return std::tie(texture, coordinates, channel);
}

template <typename T, IfIs<T, Detail>* = nullptr>
auto partsOf(T& detail) {
  auto& [contrast, coarsest_m, finest_m, gain, tint] = detail;
  return std::tie(contrast, coarsest_m, finest_m, gain, tint);
}

template <typename T, IfIs<T, Material>* = nullptr>
auto partsOf(T& material) {
  auto& [name, base_color, base_texture, roughness, metalness, roughness_map, metalness_map, normal_map,
         normal_scale, occlusion_map, occlusion_strength, emission, emission_map, lamp_group, dielectric,
         dielectric_grazing, alpha_mode, alpha_cutoff, alpha, transmission, glass, double_sided, detail] =
      material;
  return std::tie(name, base_color, base_texture, roughness, metalness, roughness_map, metalness_map,
                  normal_map, normal_scale, occlusion_map, occlusion_strength, emission, emission_map,
                  lamp_group, dielectric, dielectric_grazing, alpha_mode, alpha_cutoff, alpha, transmission,
                  glass, double_sided, detail);
}

template <typename T, IfIs<T, Mesh>* = nullptr>
auto partsOf(T& mesh) {
  auto& [name, material, positions, normals, texture_coordinates, more_texture_coordinates, tangents, colors,
         triangles] = mesh;
  return std::tie(name, material, positions, normals, texture_coordinates, more_texture_coordinates, tangents,
                  colors, triangles);
}

template <typename T, IfIs<T, Lamp>* = nullptr>
auto partsOf(T& lamp) {
  auto& [name, group, position, direction, intensity, relative, constant, linear, quadratic, range_m,
         ends_sharply, inner_rad, outer_rad, exponent, radius_m, casts_shadows] = lamp;
  return std::tie(name, group, position, direction, intensity, relative, constant, linear, quadratic, range_m,
                  ends_sharply, inner_rad, outer_rad, exponent, radius_m, casts_shadows);
}

template <typename T, IfIs<T, Scene>* = nullptr>
auto partsOf(T& scene) {
  auto& [name, textures, materials, meshes, lamps, warnings] = scene;
  return std::tie(name, textures, materials, meshes, lamps, warnings);
}

/// Whether a value is its bytes: numbers, and arrays of them of fixed size.
template <typename T>
struct IsPlain : std::bool_constant<std::is_arithmetic_v<T> || std::is_enum_v<T>> {};
template <typename T, std::size_t n>
struct IsPlain<std::array<T, n>> : IsPlain<T> {};
template <typename T, int rows, int options>
struct IsPlain<Eigen::Matrix<T, rows, 1, options>> : std::bool_constant<(rows > 0)> {};
template <typename T, int rows, int options>
struct IsPlain<Eigen::Array<T, rows, 1, options>> : std::bool_constant<(rows > 0)> {};

class Writer {
 public:
  explicit Writer(const ByteSink& sink) : sink_(sink) {}

  template <typename T>
  void operator()(const T& value) const {
    if constexpr (IsPlain<T>::value)
      sink_(&value, sizeof(value));
    else
      std::apply([this](const auto&... part) { ((*this)(part), ...); }, partsOf(value));
  }
  void operator()(const std::string& text) const { list(text); }
  void operator()(const Texels& texels) const { list(texels); }
  template <typename T>
  void operator()(const std::vector<T>& values) const {
    if constexpr (IsPlain<T>::value) return list(values);
    (*this)(static_cast<std::uint64_t>(values.size()));
    for (const T& value : values) (*this)(value);
  }

 private:
  template <typename List>
  void list(const List& values) const {
    (*this)(static_cast<std::uint64_t>(values.size()));
    sink_(values.data(), values.size() * sizeof(*values.data()));
  }
  const ByteSink& sink_;
};

class Reader {
 public:
  Reader(const std::byte* data, std::size_t size, std::shared_ptr<const image::FileBytes> owner)
      : at_(data), left_(size), owner_(std::move(owner)) {}

  template <typename T>
  void operator()(T& value) {
    if constexpr (IsPlain<T>::value)
      take(&value, sizeof(value));
    else
      std::apply([this](auto&... part) { ((*this)(part), ...); }, partsOf(value));
  }
  void operator()(std::string& text) { list(&text); }
  void operator()(Texels& texels) {
    if (!owner_) return list(&texels.own());
    const std::size_t size = count(1);
    texels = Texels::within(owner_, reinterpret_cast<const std::uint8_t*>(at_), size);
    skip(size);
  }
  template <typename T>
  void operator()(std::vector<T>& values) {
    if constexpr (IsPlain<T>::value) return list(&values);
    values.resize(count(1));
    for (T& value : values) (*this)(value);
  }
  bool atEnd() const { return left_ == 0; }

 private:
  void take(void* to, std::size_t size) {
    if (size > left_) throw std::runtime_error("a scene's bytes end too soon");
    if (size > 0) std::memcpy(to, at_, size);
    skip(size);
  }
  void skip(std::size_t size) {
    at_ += size;
    left_ -= size;
  }
  /// Of elements that take so many bytes, at least.
  std::size_t count(std::size_t bytes_each) {
    std::uint64_t number = 0;
    (*this)(number);
    if (number > left_ / bytes_each) throw std::runtime_error("a scene's bytes end too soon");
    return static_cast<std::size_t>(number);
  }
  template <typename List>
  void list(List* values) {
    values->resize(count(sizeof(*values->data())));
    take(static_cast<void*>(values->data()), values->size() * sizeof(*values->data()));
  }

  const std::byte* at_;
  std::size_t left_;
  std::shared_ptr<const image::FileBytes> owner_;  ///< of the bytes; null: they are gone when all is read
};

}  // namespace

void writeBytes(const Scene& scene, const ByteSink& sink) {
  Writer writer(sink);
  writer(scene);
}

void writeLooks(const Scene& scene, const ByteSink& sink) {
  const Writer writer(sink);
  const auto all_but_name = [&writer](const auto& /*name*/, const auto&... part) { (writer(part), ...); };
  for (const Texture& texture : scene.textures) std::apply(all_but_name, partsOf(texture));
  for (const Material& material : scene.materials) std::apply(all_but_name, partsOf(material));
  for (const Lamp& lamp : scene.lamps) std::apply(all_but_name, partsOf(lamp));
}

Scene sceneOf(const std::byte* data, std::size_t size, std::shared_ptr<const image::FileBytes> owner) {
  Reader reader(data, size, std::move(owner));
  Scene scene;
  reader(scene);
  if (!reader.atEnd()) throw std::runtime_error("more follows a scene's bytes");
  return scene;
}

}  // namespace sunlit::scene
