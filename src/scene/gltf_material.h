/// What a glTF file says of its materials, read from its JSON: Assimp hands on but a part.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scene/gltf_input.h"
#include "scene/scene_builder.h"
#include "sunlit/scene/scene.h"

namespace sunlit::scene {

/// Texture coordinates as a texture wants them: a set of the mesh, scaled, turned and moved
/// (KHR_texture_transform).
struct CoordinateRecipe {
  int set = 0;  ///< TEXCOORD_n
  Eigen::Matrix2f linear = Eigen::Matrix2f::Identity();
  Eigen::Vector2f offset = Eigen::Vector2f::Zero();

  Eigen::Vector2f operator()(const Eigen::Vector2f& coordinate) const { return linear * coordinate + offset; }
  bool operator==(const CoordinateRecipe& other) const {
    return set == other.set && linear == other.linear && offset == other.offset;
  }
};

/// A material with the coordinates of its textures: the first is Mesh::texture_coordinates.
struct GltfLook {
  Material material;
  std::vector<CoordinateRecipe> coordinates;
  bool vanishes = false;  ///< its alpha is below its cutoff everywhere
  bool fades = false;     ///< alpha counts, that of its vertices, too
};

class GltfMaterials {
 public:
  /// Parses `file`, .gltf or .glb. Throws std::runtime_error naming it.
  GltfMaterials(const std::string& file, SceneBuilder& builder);
  ~GltfMaterials();

  /// Where Assimp keeps the picture of a texture.
  enum class Slot { kBase, kDiffuse, kMetallicRoughness, kNormal, kOcclusion, kEmissive };
  /// Index of the picture in `slot` of the material, as it goes on beyond its edges; kNone if it is missing.
  using Picture = std::function<int(Slot, const Wraps&)>;

  /// Material number `index` of the file; none beyond its last: the one that stands for none. What of it
  /// cannot be shown is a warning.
  std::optional<GltfLook> look(std::size_t index, const Picture& picture) const;

  /// That of a material of the file, or "material 3".
  std::string nameOf(std::size_t index) const;

  /// What Assimp reads the file through.
  std::unique_ptr<GltfInput> input() const;

  /// materialsInFile().
  std::vector<std::size_t> order(const std::vector<std::string>& names) const;

  /// addGltfLights() of the file.
  void addLights(const Eigen::Affine3d& up_from_file) const;

  /// Warns of what the file says beside its materials, and neither this package nor Assimp reads, which has
  /// made so many triangles.
  void nameTheRest(std::uint64_t triangles) const;
  /// "; it needs …" with the extensions that are not read, which the file says it cannot do without; or
  /// nothing.
  std::string whatItNeeds() const;

 private:
  struct Json;
  std::vector<std::string> unknown(const char* list) const;

  std::string file_;
  SceneBuilder& builder_;
  std::unique_ptr<const Json> json_;
};

}  // namespace sunlit::scene
