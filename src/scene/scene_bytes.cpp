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
  auto& [name, width, height, rgba, wrap_u, wrap_v, smaller] = texture;
  return std::tie(name, width, height, rgba, wrap_u, wrap_v, smaller);
}

template <typename T, IfIs<T, TextureSize>* = nullptr>
auto partsOf(T& size) {
  auto& [width, height, rgba] = size;
  return std::tie(width, height, rgba);
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

template <typename T, IfIs<T, Shape>* = nullptr>
auto partsOf(T& shape) {
  auto& [positions, normals, texture_coordinates, more_texture_coordinates, tangents, colors, triangles,
         planes, materials, chunks] = shape;
  return std::tie(positions, normals, texture_coordinates, more_texture_coordinates, tangents, colors,
                  triangles, planes, materials, chunks);
}

template <typename T, IfIs<T, FlatScene>* = nullptr>
auto partsOf(T& flat) {
  auto& [scene, shape] = flat;
  return std::tie(scene, shape);
}

template <typename T, IfIs<T, Lamp>* = nullptr>
auto partsOf(T& lamp) {
  auto& [name, group, position, direction, intensity, relative, constant, linear, quadratic, range_m,
         ends_sharply, inner_rad, outer_rad, exponent, radius_m, housing_m, casts_shadows] = lamp;
  return std::tie(name, group, position, direction, intensity, relative, constant, linear, quadratic, range_m,
                  ends_sharply, inner_rad, outer_rad, exponent, radius_m, housing_m, casts_shadows);
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
template <>
struct IsPlain<Plane> : std::true_type {};
template <>
struct IsPlain<Chunk> : std::true_type {};

class Writer {
 public:
  explicit Writer(const ByteSink& sink) : sink_(sink) {}

  template <typename T>
  void operator()(const T& value) {
    if constexpr (IsPlain<T>::value)
      write(&value, sizeof(value));
    else
      std::apply([this](const auto&... part) { ((*this)(part), ...); }, partsOf(value));
  }
  void operator()(const std::string& text) { list(text); }
  template <typename T>
  void operator()(const image::KeptArray<T>& values) {
    (*this)(static_cast<std::uint64_t>(values.size()));
    constexpr char kZeros[image::kKeptAlignment] = {};
    write(kZeros, image::aligned(written_) - written_);
    write(values.data(), values.size() * sizeof(T));
  }
  template <typename T>
  void operator()(const std::vector<T>& values) {
    if constexpr (IsPlain<T>::value) return list(values);
    (*this)(static_cast<std::uint64_t>(values.size()));
    for (const T& value : values) (*this)(value);
  }

 private:
  template <typename List>
  void list(const List& values) {
    (*this)(static_cast<std::uint64_t>(values.size()));
    write(values.data(), values.size() * sizeof(*values.data()));
  }
  void write(const void* data, std::size_t size) {
    sink_(data, size);
    written_ += size;
  }
  const ByteSink& sink_;
  std::size_t written_ = 0;
};

class Reader {
 public:
  Reader(const std::byte* data, std::size_t size, std::shared_ptr<const image::FileBytes> owner)
      : first_(data), at_(data), left_(size), owner_(std::move(owner)) {}

  template <typename T>
  void operator()(T& value) {
    if constexpr (IsPlain<T>::value)
      take(&value, sizeof(value));
    else
      std::apply([this](auto&... part) { ((*this)(part), ...); }, partsOf(value));
  }
  void operator()(std::string& text) { list(&text); }
  template <typename T>
  void operator()(image::KeptArray<T>& values) {
    const std::size_t number = count(sizeof(T)), behind = static_cast<std::size_t>(at_ - first_);
    const std::size_t gap = image::aligned(behind) - behind;
    if (gap > left_ || number > (left_ - gap) / sizeof(T)) endsTooSoon();
    skip(gap);
    if (owner_) {
      values = image::KeptArray<T>(reinterpret_cast<const T*>(at_), number, owner_);
      return skip(number * sizeof(T));
    }
    values.resize(number);
    take(static_cast<void*>(values.data()), number * sizeof(T));
  }
  template <typename T>
  void operator()(std::vector<T>& values) {
    if constexpr (IsPlain<T>::value) return list(&values);
    values.resize(count(1));
    for (T& value : values) (*this)(value);
  }
  bool atEnd() const { return left_ == 0; }

 private:
  [[noreturn]] static void endsTooSoon() { throw std::runtime_error("a scene's bytes end too soon"); }
  void take(void* to, std::size_t size) {
    if (size > left_) endsTooSoon();
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
    if (number > left_ / bytes_each) endsTooSoon();
    return static_cast<std::size_t>(number);
  }
  template <typename List>
  void list(List* values) {
    values->resize(count(sizeof(*values->data())));
    take(static_cast<void*>(values->data()), values->size() * sizeof(*values->data()));
  }

  const std::byte* const first_;
  const std::byte* at_;
  std::size_t left_;
  std::shared_ptr<const image::FileBytes> owner_;  ///< of the bytes; null: they are gone when all is read
};

}  // namespace

void writeBytes(const FlatScene& flat, const ByteSink& sink) {
  Writer writer(sink);
  writer(flat);
}

void writeLooks(const Scene& scene, const ByteSink& sink) {
  Writer writer(sink);
  const auto all_but_name = [&writer](const auto& /*name*/, const auto&... part) { (writer(part), ...); };
  for (const Texture& texture : scene.textures) {
    const auto& [name, width, height, rgba, wrap_u, wrap_v, smaller] = texture;
    static_cast<void>(smaller);  // which follow from the others
    all_but_name(name, width, height, rgba, wrap_u, wrap_v);
  }
  for (const Material& material : scene.materials) std::apply(all_but_name, partsOf(material));
  for (const Lamp& lamp : scene.lamps) std::apply(all_but_name, partsOf(lamp));
}

FlatScene flatSceneOf(const std::byte* data, std::size_t size,
                      std::shared_ptr<const image::FileBytes> owner) {
  Reader reader(data, size, std::move(owner));
  FlatScene flat;
  reader(flat);
  if (!reader.atEnd()) throw std::runtime_error("more follows a scene's bytes");
  return flat;
}

}  // namespace sunlit::scene
