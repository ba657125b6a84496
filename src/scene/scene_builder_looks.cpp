// What SceneBuilder::finish() does to materials once their textures are decoded.
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "scene/mesh_vertices.h"
#include "scene/scene_builder.h"
#include "scene/texture_alpha.h"
#include "scene/texture_looks.h"
#include "sunlit/scene/whole_texture.h"

namespace sunlit::scene {

void SceneBuilder::settleAlpha() {
  std::vector<AlphaMeans> means(scene_.textures.size());
  for (std::size_t i = 0; i < means.size(); ++i) means[i] = meaningOf(scene_.textures[i]);
  for (std::size_t i = 0; i < scene_.materials.size(); ++i) {
    Material& material = scene_.materials[i];
    const bool textured = material.base_texture != Material::kNoTexture;
    if (material.alpha_mode == AlphaMode::kBlend) {
      const bool whole =
          !textured || isWhole(scene_.textures[static_cast<std::size_t>(material.base_texture)]);
      if (whole && material.alpha >= 1.0f) material.alpha_mode = AlphaMode::kOpaque;
    } else if (alpha_rules_[i] != AlphaRule::kDeclared && textured) {
      settleByTexture(alpha_rules_[i], means[static_cast<std::size_t>(material.base_texture)], &material);
    }
  }
}

void SceneBuilder::settleByTexture(AlphaRule rule, AlphaMeans means, Material* material) {
  if (means == AlphaMeans::kNothing) return;
  const std::string name =
      material->name + ": " + scene_.textures[static_cast<std::size_t>(material->base_texture)].name;
  const bool is_asked_for = rule != AlphaRule::kNotAskedFor;
  if (means == AlphaMeans::kCutOut || (means == AlphaMeans::kPainted && is_asked_for)) {
    material->alpha_mode = AlphaMode::kMask;
  } else if (!is_asked_for) {
    warn(kNotRendered, name + ", of whose alpha the file says nothing: drawn as opaque");
  } else if (means == AlphaMeans::kVeil) {
    material->alpha_mode = AlphaMode::kBlend;
    warn(
        kNotRendered,
        name + ", whose alpha is below one half all over: what lies behind shows through instead of nothing");
  } else if (means == AlphaMeans::kAccident) {
    warn(kNotRendered, name + ", whose alpha is 0 all over: drawn as opaque");
  }
}

void SceneBuilder::dropHeights() {
  for (std::size_t i = 0; i < scene_.materials.size(); ++i) {
    Material& material = scene_.materials[i];
    if (!material.normal_map.given()) continue;
    const auto texture = static_cast<std::size_t>(material.normal_map.texture);
    const bool shared =
        material.base_texture != Material::kNoTexture &&
        sources_[static_cast<std::size_t>(material.base_texture)].name == sources_[texture].name;
    const bool doubtful = normals_rules_[i] == NormalsRule::kMaybeHeights;
    if (!isGrey(scene_.textures[texture]) &&
        !(doubtful && (shared || !leansLittle(scene_.textures[texture]))))
      continue;
    warn(kNotRendered, material.name + ": a bump map, " + sources_[texture].name + ": without it");
    material.normal_map = TextureUse();
  }
}

/// Without coordinates all of a mesh would have the colour of a corner of its picture.
void SceneBuilder::paintByMeans() {
  std::map<int, int> painted;  // materials without their picture
  for (Mesh& mesh : scene_.meshes) {
    const auto index = static_cast<std::size_t>(mesh.material);
    const int texture = scene_.materials[index].base_texture;
    if (texture == Material::kNoTexture || !mesh.texture_coordinates.empty()) continue;
    warn("meshes have no texture coordinates, the mean colour of their picture is on them",
         mesh.name + ": " + sources_[static_cast<std::size_t>(texture)].name);
    const auto [known, is_new] = painted.try_emplace(mesh.material);
    if (is_new) {
      const Eigen::Array4f mean = meanOf(scene_.textures[static_cast<std::size_t>(texture)]);
      Material plain = scene_.materials[index];
      plain.base_texture = Material::kNoTexture;
      plain.base_color.value *= mean.head<3>();
      if (plain.alpha_mode == AlphaMode::kMask) plain.alpha_mode = AlphaMode::kOpaque;
      plain.alpha *= mean[3];
      known->second = addMaterial(plain, AlphaRule::kDeclared);
    }
    mesh.material = known->second;
  }
}

/// Of opaque ones both stay: nothing crosses them.
void SceneBuilder::joinPairs() {
  for (const std::size_t pair : pairs_) {
    Mesh& mesh = scene_.meshes[pair];
    const Material& material = scene_.materials[static_cast<std::size_t>(mesh.material)];
    if (material.alpha_mode == AlphaMode::kOpaque && material.glass <= 0.0f) continue;
    mesh.triangles.resize(mesh.triangles.size() / 2);
    keepUsed(mesh);
    mesh.material = twoSided(mesh.material);
  }
}

}  // namespace sunlit::scene
