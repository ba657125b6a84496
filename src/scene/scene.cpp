#include "sunlit/scene/scene.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "sunlit/quantity/range.h"

namespace sunlit::scene {
namespace {

[[noreturn]] void fail(const std::string& what, const std::string& name, const std::string& wrong) {
  throw std::invalid_argument(what + " '" + name + "': " + wrong);
}

/// `fail` gets the refusal of a value outside `range`.
template <typename Fail>
void checkRange(const char* key, float value, const Range& range, const Fail& fail) {
  if (range.contains(value)) return;
  constexpr int kDigits = 7;  // of a float
  fail(refusal(key, textOf(value, kDigits),
               "from " + textOf(range.low, kDigits) + " to " + textOf(range.high, kDigits)));
}

void checkRange(const Material& material, const char* key, float value, const Range& range) {
  checkRange(key, value, range, [&](const std::string& wrong) { fail("material", material.name, wrong); });
}

void checkTexture(const Texture& texture) {
  if (texture.width <= 0 || texture.height <= 0) fail("texture", texture.name, "it has no pixels");
  const std::size_t expected =
      std::size_t{4} * static_cast<std::size_t>(texture.width) * static_cast<std::size_t>(texture.height);
  if (texture.rgba.size() != expected) {
    fail("texture", texture.name,
         "it holds " + std::to_string(texture.rgba.size()) + " bytes, not " + std::to_string(expected));
  }
}

void checkDetail(const Material& material) {
  const Detail& detail = material.detail;
  checkRange(material, "detail.contrast", detail.contrast, {0.0f, 1.0f});
  checkRange(material, "detail.gain", detail.gain, {0.0f, 1.5f});
  for (const float tint : detail.tint) checkRange(material, "detail.tint", tint, {0.0f, 2.0f});
  if (!(detail.finest_m > 0.0f) || !(detail.coarsest_m > detail.finest_m) ||
      !std::isfinite(detail.coarsest_m)) {
    fail("material", material.name, "detail must have 0 < finest_m < coarsest_m");
  }
}

void checkTextureUse(const Material& material, const TextureUse& use, std::size_t texture_count) {
  const bool known =
      !use.given() || (use.texture >= 0 && static_cast<std::size_t>(use.texture) < texture_count);
  if (!known) fail("material", material.name, "there is no texture " + std::to_string(use.texture));
  if (use.channel < 0 || use.channel > 3) {
    fail("material", material.name,
         refusal("channel of a texture", std::to_string(use.channel), "from 0 to 3"));
  }
  if (use.coordinates < 0) {
    fail("material", material.name,
         refusal("coordinates of a texture", std::to_string(use.coordinates), "at least 0"));
  }
}

void checkMaterial(const Material& material, std::size_t texture_count) {
  for (const float channel : material.base_color.value)
    checkRange(material, "base_color", channel, {0.0f, 1.0f});
  checkRange(material, "roughness", material.roughness, {Material::kSmoothest, 1.0f});
  checkRange(material, "metalness", material.metalness, {0.0f, 1.0f});
  checkRange(material, "alpha_cutoff", material.alpha_cutoff, {0.0f, 1.0f});
  checkRange(material, "alpha", material.alpha, {0.0f, 1.0f});
  checkRange(material, "normal_scale", material.normal_scale, {-8.0f, 8.0f});
  checkRange(material, "occlusion_strength", material.occlusion_strength, {0.0f, 1.0f});
  for (const float channel : material.dielectric.value)
    checkRange(material, "dielectric", channel, {0.0f, 1.0f});
  checkRange(material, "dielectric_grazing", material.dielectric_grazing, {0.0f, 1.0f});
  checkRange(material, "transmission", material.transmission, {0.0f, 1.0f});
  checkRange(material, "glass", material.glass, {0.0f, 1.0f});
  checkDetail(material);
  for (const float channel : material.emission.value) {
    if (!std::isfinite(channel) || channel < 0.0f)
      fail("material", material.name, refusal("emission", textOf(channel), "at least 0"));
  }
  for (const TextureUse& use :
       {TextureUse{material.base_texture}, material.roughness_map, material.metalness_map,
        material.normal_map, material.occlusion_map, material.emission_map})
    checkTextureUse(material, use, texture_count);
}

void checkLengths(const Mesh& mesh) {
  const std::size_t count = mesh.positions.size();
  if (mesh.normals.size() != count) fail("mesh", mesh.name, "it must have one normal a vertex");
  if (!mesh.texture_coordinates.empty() && mesh.texture_coordinates.size() != count) {
    fail("mesh", mesh.name, "it must have one texture coordinate a vertex, or none");
  }
  for (const auto& coordinates : mesh.more_texture_coordinates) {
    if (!coordinates.empty() && coordinates.size() != count)
      fail("mesh", mesh.name, "it must have one texture coordinate a vertex, or none, in each set");
  }
  if (!mesh.tangents.empty() && mesh.tangents.size() != count) {
    fail("mesh", mesh.name, "it must have one tangent a vertex, or none");
  }
  if (!mesh.colors.empty() && mesh.colors.size() != count) {
    fail("mesh", mesh.name, "it must have one colour a vertex, or none");
  }
}

void checkVertex(const Mesh& mesh, std::size_t i) {
  const auto failHere = [&](const std::string& wrong) {
    fail("mesh", mesh.name, "vertex " + std::to_string(i) + ": " + wrong);
  };
  if (!mesh.positions[i].allFinite()) failHere("position is not finite");
  if ((mesh.positions[i].array().abs() > kFarthest_m).any()) {
    failHere(
        "position is farther than 100 km from the origin, where coordinates are a centimetre apart; move "
        "the world to its origin");
  }
  // Written so that a NaN fails; 1e-3 is far above what rounding and transforms do to a unit float vector.
  if (!(std::abs(mesh.normals[i].norm() - 1.0f) < 1e-3f)) failHere("normal is not of length 1");
  const Range coordinates{-kLargestTextureCoordinate, kLargestTextureCoordinate};
  for (int k = 0; !mesh.texture_coordinates.empty() && k < 2; ++k)
    checkRange("texture coordinate", mesh.texture_coordinates[i][k], coordinates, failHere);
  for (const auto& more : mesh.more_texture_coordinates) {
    for (int k = 0; !more.empty() && k < 2; ++k)
      checkRange("texture coordinate", more[i][k], coordinates, failHere);
  }
  if (!mesh.tangents.empty() && !(std::abs(mesh.tangents[i].head<3>().norm() - 1.0f) < 1e-3f))
    failHere("tangent is not of length 1");
  for (int k = 0; !mesh.colors.empty() && k < 3; ++k)
    checkRange("colour", mesh.colors[i][k], {0.0, 2.0}, failHere);
}

void checkCounts(const Scene& scene) {
  std::size_t triangles = 0, vertices = 0;
  for (const Mesh& mesh : scene.meshes) {
    triangles += mesh.triangles.size();
    vertices += mesh.positions.size();
    if (triangles > kMostTriangles || vertices > kMostVertices)
      fail("mesh", mesh.name,
           "up to it there are " + std::to_string(triangles) + " triangles and " + std::to_string(vertices) +
               " vertices, but there must be at most " + std::to_string(kMostTriangles) + " and " +
               std::to_string(kMostVertices));
  }
}

void checkMesh(const Mesh& mesh, std::size_t material_count) {
  const std::size_t count = mesh.positions.size();
  if (mesh.material < 0 || static_cast<std::size_t>(mesh.material) >= material_count) {
    fail("mesh", mesh.name, "there is no material " + std::to_string(mesh.material));
  }
  checkLengths(mesh);
  for (std::size_t i = 0; i < count; ++i) checkVertex(mesh, i);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (const std::uint32_t corner : mesh.triangles[i]) {
      if (corner >= count) {
        fail("mesh", mesh.name,
             "triangle " + std::to_string(i) + ": there is no vertex " + std::to_string(corner));
      }
    }
  }
}

void checkLamp(const Lamp& lamp) {
  const auto failHere = [&](const std::string& wrong) { fail("lamp", lamp.name, wrong); };
  if (!lamp.position.allFinite() || (lamp.position.array().abs() > kFarthest_m).any())
    failHere("position is not finite or farther than 100 km from the origin");
  // As for normals of meshes; written so that a NaN fails.
  if (!(std::abs(lamp.direction.norm() - 1.0f) < 1e-3f)) failHere("direction is not of length 1");
  for (const float channel : lamp.intensity.value) {
    if (!std::isfinite(channel) || channel < 0.0f)
      failHere(refusal("intensity", textOf(channel), "at least 0"));
  }
  const float largest = std::numeric_limits<float>::max();
  checkRange("constant", lamp.constant, {0.0f, largest}, failHere);
  checkRange("linear", lamp.linear, {0.0f, largest}, failHere);
  checkRange("quadratic", lamp.quadratic, {0.0f, largest}, failHere);
  if (!(lamp.constant + lamp.linear + lamp.quadratic > 0.0f))
    failHere("constant, linear and quadratic must not all be 0");
  if (!(lamp.range_m > 0.0f)) failHere(refusal("range_m", textOf(lamp.range_m), "above 0"));
  checkRange("outer_rad", lamp.outer_rad, {0.0f, Lamp::kAllAround_rad}, failHere);
  checkRange("inner_rad", lamp.inner_rad, {0.0f, lamp.outer_rad}, failHere);
  checkRange("exponent", lamp.exponent, {0.0f, 100.0f}, failHere);
  checkRange("radius_m", lamp.radius_m, {0.0f, 10.0f}, failHere);
  checkRange("housing_m", lamp.housing_m, {0.0f, 10.0f}, failHere);
}

}  // namespace

void letGoOfTexels(const Scene& scene) {
  for (const Texture& texture : scene.textures) texture.rgba.letGo();
}

void validate(const Scene& scene) {
  for (const Texture& texture : scene.textures) checkTexture(texture);
  for (const Material& material : scene.materials) checkMaterial(material, scene.textures.size());
  checkCounts(scene);
  for (const Mesh& mesh : scene.meshes) checkMesh(mesh, scene.materials.size());
  for (const Lamp& lamp : scene.lamps) checkLamp(lamp);
}

}  // namespace sunlit::scene
