#include "scene/scene_builder.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "scene/back_to_back.h"
#include "scene/cofactors.h"
#include "scene/color.h"
#include "scene/mesh_directions.h"
#include "scene/missing_kinds.h"
#include "scene/square_texels.h"
#include "sunlit/image/texture_files.h"
#include "sunlit/scene/material_maps.h"

namespace sunlit::scene {
namespace {

/// Twice the area, m², below which a triangle is taken for none: no camera sees a hundredth of a square
/// millimetre.
constexpr double kNoArea_m2 = 1e-12;

/// As many a person reads of a kind.
constexpr std::size_t kExamples = 3;

image::Rgba8Image white(const image::Rgba8Image& as_large) {
  image::Rgba8Image picture(as_large.width, as_large.height);
  std::fill(picture.data.begin(), picture.data.end(), std::uint8_t{255});
  return picture;
}

/// What an example is about, such as a material, of which it may name one feature of several.
std::string subjectOf(const std::string& where) {
  return where.substr(0, where.find(": "));
}

/// The latest of `examples` whose subject an earlier one has, too; their end where there is none.
std::vector<std::string>::iterator repeatedIn(std::vector<std::string>& examples) {
  std::set<std::string> subjects;
  auto repeated = examples.end();
  for (auto example = examples.begin(); example != examples.end(); ++example)
    if (!subjects.insert(subjectOf(*example)).second) repeated = example;
  return repeated;
}

std::string canonical(const std::string& file) {
  if (file.empty()) return file;
  std::error_code error;
  const std::filesystem::path path = std::filesystem::weakly_canonical(file, error);
  return error ? file : path.string();
}

bool isFar(const Mesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  return std::any_of(triangle.begin(), triangle.end(), [&](std::uint32_t corner) {
    return !(mesh.positions[corner].array().abs() <= kFarthest_m).all();
  });
}

/// `picture` with the opacity that `by` means.
image::Rgba8Image coveredAs(const OpacityPicture& means, const image::Rgba8Image& picture,
                            image::Rgba8Image by) {
  for (std::size_t i = 3; means.of_colors && i < by.data.size(); i += 4) by.data[i] = 255;
  image::Rgba8Image covered = image::coveredBy(picture, by);
  const float share = std::fmin(std::fmax(means.share, 0.0f), 1.0f);
  for (std::size_t i = 3; i < covered.data.size(); i += 4) {
    const auto part = static_cast<std::uint8_t>(std::lround(share * static_cast<float>(covered.data[i])));
    covered.data[i] = means.is_transparency ? static_cast<std::uint8_t>(255 - part) : part;
  }
  return covered;
}

}  // namespace

int SceneBuilder::textureFromFile(const std::string& file, const Wraps& wraps,
                                  const OpacityPicture& opacity) {
  TextureSource source{canonical(file), {}, false, wraps, opacity};
  source.opacity.file = canonical(opacity.file);
  std::string key = source.name;
  if (!opacity.file.empty()) key += " by " + source.opacity.file;
  if (opacity.is_transparency) key += " which is transparency";
  if (opacity.of_colors) key += " of its colours";
  if (opacity.share < 1.0f) key += " times " + std::to_string(opacity.share);
  return addTexture(key, std::move(source));
}

int SceneBuilder::textureFromBytes(const std::string& name, std::vector<std::uint8_t> bytes,
                                   const Wraps& wraps) {
  return addTexture(name, TextureSource{name, std::move(bytes), true, wraps});
}

int SceneBuilder::addTexture(const std::string& key, TextureSource source) {
  const int wraps = 3 * static_cast<int>(source.wraps.u) + static_cast<int>(source.wraps.v) +
                    (source.wraps.squares ? 9 : 0);
  const auto [place, is_new] =
      texture_by_key_.emplace(std::make_pair(key, wraps), static_cast<int>(sources_.size()));
  if (is_new) sources_.push_back(std::move(source));
  return place->second;
}

int SceneBuilder::addMaterial(const Material& material, AlphaRule alpha, NormalsRule normals) {
  scene_.materials.push_back(material);
  alpha_rules_.push_back(alpha);
  normals_rules_.push_back(normals);
  return static_cast<int>(scene_.materials.size()) - 1;
}

int SceneBuilder::oneSided(int material) {
  const auto index = static_cast<std::size_t>(material);
  if (!scene_.materials.at(index).double_sided) return material;
  const auto known = one_sided_.find(material);
  if (known != one_sided_.end()) return known->second;
  Material front = scene_.materials[index];
  front.double_sided = false;
  return one_sided_[material] = addMaterial(front, alpha_rules_[index], normals_rules_[index]);
}

int SceneBuilder::twoSided(int material) {
  const auto index = static_cast<std::size_t>(material);
  if (scene_.materials.at(index).double_sided) return material;
  for (const auto& [both, front] : one_sided_) {
    if (front == material) return both;
  }
  const auto known = two_sided_.find(material);
  if (known != two_sided_.end()) return known->second;
  Material both = scene_.materials[index];
  both.double_sided = true;
  return two_sided_[material] = addMaterial(both, alpha_rules_[index], normals_rules_[index]);
}

int SceneBuilder::veiled(int material, float opacity, Faces faces) {
  const auto index = static_cast<std::size_t>(material);
  Material veil = scene_.materials.at(index);
  const bool blends = veil.alpha_mode == AlphaMode::kBlend;
  const float all = (blends ? veil.alpha : 1.0f) * opacity;
  if (veil.glass > 0.0f || all >= 1.0f) return material;
  const auto known = veiled_.find({material, opacity, faces});
  if (known != veiled_.end()) return known->second;
  veil.alpha_mode = AlphaMode::kBlend;
  veil.alpha = faces == Faces::kTwo ? 1.0f - std::sqrt(1.0f - all) : all;
  return veiled_[{material, opacity, faces}] = addMaterial(veil, AlphaRule::kDeclared, normals_rules_[index]);
}

void SceneBuilder::addMesh(const Mesh& mesh, const Eigen::Affine3d& map_from_mesh) {
  budget_.take(mesh.triangles.size(), mesh.positions.size(), scene_.name + ": mesh " + mesh.name);
  Mesh moved = mesh;
  const Eigen::Matrix3d linear = map_from_mesh.linear();
  Eigen::Matrix3d normals_linear = cofactors(linear);
  const bool mirrored = linear.determinant() < 0.0;
  if (mirrored) normals_linear = -normals_linear;
  for (Eigen::Vector3f& position : moved.positions) {
    position = (map_from_mesh * position.cast<double>()).cast<float>();
  }
  for (Eigen::Vector3f& normal : moved.normals) {
    const Eigen::Vector3d turned = normals_linear * normal.cast<double>();
    normal = turned.normalized().cast<float>();  // Eigen leaves a zero vector as it is; see repairNormals
  }
  turnTangents(linear, moved);

  std::vector<std::array<std::uint32_t, 3>> kept;
  kept.reserve(moved.triangles.size());
  for (const auto& triangle : moved.triangles) {
    const double area = faceVector(moved, triangle).norm();
    if (!std::isfinite(area)) {
      count("triangles with coordinates that are not finite were left out", mesh.name);
    } else if (isFar(moved, triangle)) {
      warn(
          "meshes reach farther than 100 km from the origin, what of them does was left out "
          "(coordinates of a map, such as UTM's, need an offset taken off)",
          mesh.name);
    } else if (area < kNoArea_m2) {
      count("triangles without area were left out", mesh.name);
    } else {
      kept.push_back(mirrored ? std::array<std::uint32_t, 3>{triangle[0], triangle[2], triangle[1]}
                              : triangle);
    }
  }
  if (kept.empty()) return;
  moved.triangles = std::move(kept);
  for (Eigen::Vector3f& position : moved.positions) {
    // Of a vertex that no triangle uses any more.
    if (!(position.array().abs() <= kFarthest_m).all()) position.setZero();
  }
  repairCoordinates(mesh.name, moved.texture_coordinates);
  for (auto& coordinates : moved.more_texture_coordinates) repairCoordinates(mesh.name, coordinates);
  for (Eigen::Array3f& color : moved.colors) color = color.max(0.0f).min(1.0f);
  repairNormals(moved);
  scene_.meshes.push_back(std::move(moved));
}

bool SceneBuilder::hasMaps(int index) {
  Material& material = scene_.materials[static_cast<std::size_t>(index)];
  const auto maps = mapsOf(material);
  return material.base_texture != Material::kNoTexture ||
         std::any_of(maps.begin(), maps.end(), [](const TextureUse* map) { return map->given(); });
}

void SceneBuilder::addPiece(const Mesh& mesh, const Eigen::Affine3d& map_from_mesh) {
  const std::size_t before = meshCount();
  addMesh(mesh, map_from_mesh);
  if (meshCount() == before) return;
  Mesh& added = scene_.meshes.back();
  const auto index = static_cast<std::size_t>(added.material);
  const bool whole = scene_.materials[index].alpha_mode == AlphaMode::kOpaque &&
                     scene_.materials[index].glass <= 0.0f &&
                     (alpha_rules_[index] == AlphaRule::kDeclared ||
                      scene_.materials[index].base_texture == Material::kNoTexture);
  if (whole) return;
  Mesh pairs = pairsFrom(added, hasMaps(added.material));
  if (pairs.triangles.empty()) return;
  if (added.triangles.empty()) scene_.meshes.pop_back();
  pairs_.push_back(meshCount());
  scene_.meshes.push_back(std::move(pairs));
}

void SceneBuilder::repairCoordinates(const std::string& mesh, std::vector<Eigen::Vector2f>& coordinates) {
  for (Eigen::Vector2f& coordinate : coordinates) {
    if (!coordinate.allFinite()) {
      coordinate.setZero();
      count("texture coordinates that are not finite were set to 0", mesh);
    } else if (!(coordinate.array().abs() <= kLargestTextureCoordinate).all()) {
      coordinate.setZero();
      count("texture coordinates outside -1e6 … 1e6 were set to 0", mesh);
    }
  }
}

std::string reasonsOf(const std::vector<std::string>& warnings) {
  constexpr std::size_t kReasons = 3;
  std::vector<std::string> sorted = warnings;
  std::stable_partition(sorted.begin(), sorted.end(), [](const std::string& warning) {
    return warning.find(kMissingModels) != std::string::npos ||
           warning.find(kMissingMeshes) != std::string::npos;
  });
  std::string text;
  for (std::size_t i = 0; i < std::min(sorted.size(), kReasons); ++i) text += "; " + sorted[i];
  if (sorted.size() > kReasons) text += "; and " + std::to_string(sorted.size() - kReasons) + " more";
  return text;
}

bool canShine(const Lamp& lamp) {
  const float falling = lamp.constant + lamp.linear + lamp.quadratic;
  return falling > 0.0f && std::isfinite(falling) &&
         std::min({lamp.constant, lamp.linear, lamp.quadratic, lamp.inner_rad}) >= 0.0f &&
         lamp.range_m > 0.0f && lamp.outer_rad > 0.0f && lamp.inner_rad <= lamp.outer_rad &&
         lamp.direction.norm() > 0.5f && (lamp.intensity.value >= 0.0f).all() &&
         lamp.intensity.value.allFinite();
}

void SceneBuilder::addLamp(Lamp lamp) {
  // Written so that a NaN is left out.
  if (!(lamp.position.array().abs() <= kFarthest_m).all()) {
    warn("lamps farther than 100 km from the origin were left out", lamp.name);
    return;
  }
  if (!canShine(lamp)) {
    warn(kDarkLights, lamp.name);
    return;
  }
  scene_.lamps.push_back(std::move(lamp));
}

void SceneBuilder::warn(const std::string& line) {
  std::vector<std::string>& lines = scene_.warnings;
  if (std::find(lines.begin(), lines.end(), line) == lines.end()) lines.push_back(line);
}

void SceneBuilder::warn(const std::string& what, const std::string& where) {
  if (kinds_[what].known.count(where) == 0) count(what, where);
}

void SceneBuilder::count(const std::string& what, const std::string& where) {
  Kind& kind = kinds_[what];
  ++kind.times;
  const bool is_new = !where.empty() && kind.known.insert(where).second;
  if (!is_new) return;
  std::vector<std::string>& examples = kind.examples;
  if (examples.size() == kExamples) {
    const auto isOfSame = [&](const std::string& other) { return subjectOf(other) == subjectOf(where); };
    const auto repeated = repeatedIn(examples);
    if (repeated == examples.end() || std::any_of(examples.begin(), examples.end(), isOfSame)) return;
    examples.erase(repeated);
  }
  examples.push_back(where);
}

SceneBuilder::Decoded SceneBuilder::decoded(const TextureSource& source) {
  const auto read = [](const std::string& file) { return image::readRgbaWithin(kLongestTextureSide, file); };
  const std::string& name = source.name.empty() ? source.opacity.file : source.name;
  image::FittedImage fitted =
      source.embedded
          ? image::decodeRgbaWithin(kLongestTextureSide, source.bytes.data(), source.bytes.size(), name)
          : read(name);
  image::Rgba8Image& picture = fitted.picture;
  Decoded decoded;
  if (picture.width != fitted.width || picture.height != fitted.height)
    decoded.size_in_file = std::to_string(fitted.width) + " × " + std::to_string(fitted.height) + " px";
  if (source.name.empty()) {
    picture = coveredAs(source.opacity, white(picture), picture);
  } else if (!source.opacity.file.empty()) {
    try {
      picture = coveredAs(source.opacity, picture, read(source.opacity.file).picture);
    } catch (const std::runtime_error& error) {
      decoded.lost_opacity = error.what();
    }
  }
  decoded.blended = source.wraps.squares && std::max(picture.width, picture.height) > kLongestOfSquares;
  if (source.wraps.squares) picture = withSquares(picture);
  decoded.texture = {name,           picture.width, picture.height, std::move(picture.data),
                     source.wraps.u, source.wraps.v};
  return decoded;
}

void SceneBuilder::decodeTextures() {
  scene_.textures.resize(sources_.size());
  std::vector<std::string> errors(sources_.size());
  constexpr const char* kBroken = "textures cannot be decoded, neutral ones take their place";
  std::vector<const char*> faults(sources_.size(), kBroken);
  std::vector<std::string> sizes(sources_.size());
  std::vector<std::string> lost(sources_.size());
  std::vector<char> blended(sources_.size(), 0);
  tbb::parallel_for(std::size_t{0}, sources_.size(), [&](std::size_t i) {
    try {
      Decoded texture = decoded(sources_[i]);
      scene_.textures[i] = std::move(texture.texture);
      sizes[i] = std::move(texture.size_in_file);
      lost[i] = std::move(texture.lost_opacity);
      blended[i] = texture.blended ? 1 : 0;
    } catch (const image::ContentMissing& error) {
      errors[i] = error.what();
      faults[i] = kMissingTextures;
    } catch (const std::runtime_error& error) {
      errors[i] = error.what();
    }
  });
  const std::string shrunk =
      "textures were scaled down to a longest side of " + std::to_string(kLongestTextureSide) + " px";
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    if (!lost[i].empty()) warn("pictures of opacity cannot be decoded, what has them is whole", lost[i]);
    if (!sizes[i].empty()) warn(shrunk, sources_[i].name + " of " + sizes[i]);
    if (blended[i])
      warn("textures are too large for hard edges between texels, they are blended", sources_[i].name);
    if (errors[i].empty()) continue;
    warn(faults[i], errors[i]);
    forgetTexture(static_cast<int>(i));
  }
}

/// Nothing of a scene may have a size of 0, so that a texel stays of it.
void SceneBuilder::forgetTexture(int texture) {
  scene_.textures[static_cast<std::size_t>(texture)] =
      Texture{sources_[static_cast<std::size_t>(texture)].name, 1, 1, {255, 255, 255, 255}};
  for (Material& material : scene_.materials) {
    if (material.metalness_map.texture == texture) material.metalness = 0.0f;
    // What shines by a picture is not to shine all over without it.
    if (material.emission_map.texture == texture) material.emission = LinearRgb();
    for (TextureUse* map : mapsOf(material)) {
      if (map->texture == texture) *map = TextureUse();
    }
    if (material.base_texture != texture) continue;
    material.base_texture = Material::kNoTexture;
    material.base_color = kNeutral;
    if (material.alpha_mode == AlphaMode::kMask) material.alpha_mode = AlphaMode::kOpaque;
  }
}

Scene SceneBuilder::finish() {
  decodeTextures();
  dropHeights();
  settleAlpha();
  paintByMeans();
  joinPairs();
  for (const auto& [what, kind] : kinds_) {
    std::string line = std::to_string(kind.times) + " " + what;
    for (std::size_t i = 0; i < kind.examples.size(); ++i) line += (i == 0 ? ": " : "; ") + kind.examples[i];
    if (kind.examples.size() < kind.known.size()) line += "; …";
    warn(line);
  }
  try {
    validate(scene_);
  } catch (const std::invalid_argument& error) {  // which knows no files
    throw std::runtime_error(scene_.name + ": " + error.what());
  }
  Scene finished = std::move(scene_);
  *this = SceneBuilder("");
  return finished;
}

}  // namespace sunlit::scene
