/// What there is to see: textured triangle meshes in the `map` frame.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "sunlit/image/kept_array.h"
#include "sunlit/quantity/photometry.h"

namespace sunlit::scene {

/// How a texture goes on beyond its edges (glTF 2.0, section 3.8.2).
enum class Wrap {
  kRepeat,
  kMirror,  ///< every second repeat is turned about
  kClamp,   ///< the texels at the edge
};

/// The bytes of a texture.
using Texels = image::KeptArray<std::uint8_t>;

/// One of the ever smaller versions of a texture.
struct TextureSize {
  int width = 0, height = 0;  ///< px
  Texels rgba;                ///< as those of the texture
};

/// 8-bit RGBA: colour sRGB-encoded, alpha linear; used as data, all four linear. Row-major, top row first;
/// texture coordinate (0, 0) is the top left corner (glTF).
struct Texture {
  std::string name;
  int width = 0;   ///< px, > 0
  int height = 0;  ///< px, > 0
  Texels rgba;
  /// Cut-outs repeat all the same.
  Wrap wrap_u = Wrap::kRepeat, wrap_v = Wrap::kRepeat;
  /// By render::addSmallerSizes(); empty: whoever draws it makes them.
  std::vector<TextureSize> smaller = {};
};

/// Where a surface takes one of its properties from.
struct TextureUse {
  static constexpr int kNone = -1;
  int texture = kNone;  ///< index into Scene::textures
  int coordinates = 0;  ///< 0: Mesh::texture_coordinates; k: Mesh::more_texture_coordinates[k − 1]
  int channel = 0;      ///< of a property of one number: 0 red … 3 alpha

  bool given() const { return texture != kNone; }
};

/// Fractal variation of the albedo, computed from the position in `map` and therefore never repeated. Octaves
/// of noise from `coarsest_m` to `finest_m` wavelength; each finer octave has `gain` times the contrast of
/// the one before. No contrast, no detail. Octaves finer than a pixel fade out.
struct Detail {
  float contrast = 0.0f;    ///< standard deviation of the summed noise, relative to the albedo, 0 … 1
  float coarsest_m = 8.0f;  ///< > finest_m
  float finest_m = 0.01f;   ///< > 0
  float gain = 0.8f;        ///< 0 … 1.5
  Eigen::Array3f tint{1.0f, 1.0f, 1.0f};  ///< contrast per channel, 0 … 2; unequal values vary the hue
};

enum class AlphaMode {
  kOpaque,  ///< alpha is ignored
  kMask,    ///< cut out where alpha < alpha_cutoff, in the image and in the shadows alike
  kBlend,   ///< alpha is the share of the surface that is there; the rest lets light through
};

/// Metallic-roughness material as in glTF 2.0. Where a mesh lacks the texture coordinates of a map, the map
/// does not count.
struct Material {
  static constexpr int kNoTexture = -1;
  static constexpr float kSmoothest = 0.03f;  ///< the lowest roughness

  std::string name;
  LinearRgb base_color{0.5f, 0.5f, 0.5f};  ///< reflectance, 0 … 1; multiplies texture and vertex colour
  int base_texture = kNoTexture;           ///< index into Scene::textures
  float roughness = 0.9f;                  ///< perceptual, kSmoothest … 1
  float metalness = 0.0f;                  ///< 0 … 1
  TextureUse roughness_map;                ///< data; times roughness, not below kSmoothest
  TextureUse metalness_map;                ///< data; times metalness
  /// Data: r g b are x, y, z of the normal, from −1 to 1, in the frame of the texture: x to its right, y to
  /// its top, z out of it.
  TextureUse normal_map;
  float normal_scale = 1.0f;     ///< times x and y, −8 … 8
  TextureUse occlusion_map;      ///< data: the share of ambient light that reaches the surface
  float occlusion_strength = 1;  ///< how much of that counts, 0 … 1
  LinearRgb emission;            ///< luminance that the surface gives off by itself, cd/m²
  TextureUse emission_map;       ///< colour; times emission
  /// Of a bulb or a lit window: it shows its emission only while lamps of that group burn, and lights nothing
  /// by it, which is what those lamps are for. Empty: it shines always, and lights what is around.
  std::string lamp_group;
  /// Reflectance of what is not metal, at normal incidence and at grazing: 0 … 1. The former is that of a
  /// refractive index of 1.5.
  LinearRgb dielectric{0.04f, 0.04f, 0.04f};
  float dielectric_grazing = 1.0f;
  AlphaMode alpha_mode = AlphaMode::kOpaque;
  float alpha_cutoff = 0.5f;  ///< 0 … 1
  float alpha = 1.0f;         ///< of kBlend, times that of the texture; 0 … 1
  /// A thin sheet such as a leaf: the share of its diffuse light that comes out on the other side, 0 … 1.
  float transmission = 0.0f;
  /// A thin, clear sheet such as a window pane: the share of what neither face mirrors that goes straight
  /// through, times base_color, 0 … 1. Not of sheets with transmission, nor of metal.
  float glass = 0.0f;
  bool double_sided = true;  ///< false: invisible from behind; still casts shadows
  Detail detail;
};

/// Of all meshes of a scene together. A triangle of corners of its own takes some 0.4 kB here and among the
/// rays, which makes 20 GB of so many; their numbers have 32 bits.
constexpr std::size_t kMostTriangles = 50000000;
constexpr std::size_t kMostVertices = 3 * kMostTriangles;

/// m from the origin along an axis, where single precision still knows a centimetre.
constexpr float kFarthest_m = 1e5f;

/// Beyond it a float hardly tells the texels of one repeat apart, and far beyond it the number of repeats is
/// no whole number any more.
constexpr float kLargestTextureCoordinate = 1e6f;

/// Triangles of one material. Positions and unit normals in `map`, m. Front faces run counter-clockwise.
struct Mesh {
  std::string name;
  int material = 0;                        ///< index into Scene::materials
  std::vector<Eigen::Vector3f> positions;  ///< m, within ±kFarthest_m
  std::vector<Eigen::Vector3f> normals;    ///< one a vertex
  std::vector<Eigen::Vector2f>
      texture_coordinates;  ///< of the base texture: one a vertex within ±kLargestTextureCoordinate, or empty
  /// Of other maps, see TextureUse: likewise.
  std::vector<std::vector<Eigen::Vector2f>> more_texture_coordinates;
  /// Unit vectors to the right of the normal map, and ±1: the bitangent, to its top, is cross(normal,
  /// tangent) times that. One a vertex, or empty: they follow from the texture coordinates.
  std::vector<Eigen::Vector4f> tangents;
  std::vector<Eigen::Array3f>
      colors;  ///< linear factor, 0 … 2 (above 1 lightens a texture), one a vertex, or empty for 1
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// A light made by people: a point or, with a cone, a spot. At the distance d, m, a plane that faces it gets
/// intensity / (constant + linear · d + quadratic · d²), lx, times 1 − (d / range_m)⁴ up to `range_m`
/// (KHR_lights_punctual), and within the cone
/// falloff(c) = ((c − cos outer) / (cos inner − cos outer))^exponent, cut off at 0 and 1, of that, where c is
/// the cosine of the angle to the axis. The default is the inverse square, and `intensity` then in cd.
struct Lamp {
  static constexpr float kUsualRadius_m = 0.05f;
  static constexpr float kAllAround_rad = 3.14159265f;

  std::string name;
  std::string group;  ///< of lamps that are switched together: the name of their model or file
  Eigen::Vector3f position = Eigen::Vector3f::Zero();  ///< m in `map`, within ±kFarthest_m
  Eigen::Vector3f direction{0.0f, 0.0f, -1.0f};        ///< unit, of the cone's axis, away from the lamp
  LinearRgb intensity;                                 ///< ≥ 0; cd, or no unit where `relative`
  bool relative = false;  ///< `intensity` is a colour of a format that knows no unit
  float constant = 0.0f, linear = 0.0f, quadratic = 1.0f;  ///< ≥ 0, not all 0; 1, 1/m, 1/m²
  float range_m = std::numeric_limits<float>::infinity();  ///< > 0; no light beyond
  bool ends_sharply = false;         ///< at `range_m`, as lights of SDF do, instead of fading towards it
  float inner_rad = kAllAround_rad;  ///< from the axis, 0 … outer_rad
  float outer_rad = kAllAround_rad;  ///< up to kAllAround_rad, which is no cone at all
  float exponent = 2.0f;             ///< 0 … 100, of the falloff between them
  float radius_m = kUsualRadius_m;  ///< of the ball that its light comes from, 0 … 10: how soft shadows are
  /// What is nearer than this, or within that ball, is part of the lamp and hides nothing, 0 … 10.
  float housing_m = 0.0f;
  bool casts_shadows = true;

  bool isSpot() const { return outer_rad < kAllAround_rad; }
};

struct Scene {
  std::string name;
  std::vector<Texture> textures;
  std::vector<Material> materials;
  std::vector<Mesh> meshes;
  std::vector<Lamp> lamps;
  std::vector<std::string> warnings;  ///< what was amiss in its files and how it was made good, a line each

  std::size_t triangleCount() const {
    std::size_t count = 0;
    for (const Mesh& mesh : meshes) count += mesh.triangles.size();
    return count;
  }
};

/// For who has looked at all texels of `scene`, of which pictures look at few: see Texels::letGo().
void letGoOfTexels(const Scene& scene);

/// Throws std::invalid_argument naming mesh, material or lamp and what is wrong: an index out of range,
/// arrays of unequal length, a value that is not finite or out of the range given above, more triangles or
/// vertices than a scene may have.
void validate(const Scene& scene);

}  // namespace sunlit::scene
