#include "render/textures.h"

#include <tbb/parallel_for.h>

#include "render/mipmaps.h"

namespace sunlit::render {
namespace {

/// The cutoff of the first material that masks with each texture.
std::vector<float> cutoffs(const scene::Scene& scene) {
  std::vector<float> values(scene.textures.size(), kNoCutoff);
  for (const scene::Material& material : scene.materials) {
    if (material.alpha_mode != scene::AlphaMode::kMask ||
        material.base_texture == scene::Material::kNoTexture)
      continue;
    float& value = values[static_cast<std::size_t>(material.base_texture)];
    if (value == kNoCutoff) value = material.alpha_cutoff;
  }
  return values;
}

void uploadLevel(int level, int width, int height, const std::uint8_t* rgba) {
  glTexSubImage2D(GL_TEXTURE_2D, level, 0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, rgba);
}

}  // namespace

Textures::Textures(const scene::Scene& scene, double lod_bias) : names_(scene.textures.size() + 1) {
  glGenTextures(static_cast<GLsizei>(names_.size()), names_.data());
  for (GLuint name : names_) {
    glBindTexture(GL_TEXTURE_2D, name);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameterf(GL_TEXTURE_2D, GL_TEXTURE_LOD_BIAS, static_cast<float>(lod_bias));
  }
  upload(scene);
}

void Textures::upload(const scene::Scene& scene) {
  std::vector<std::vector<MipLevel>> levels(scene.textures.size());
  const std::vector<float> cutoff = cutoffs(scene);
  tbb::parallel_for(std::size_t{0}, scene.textures.size(),
                    [&](std::size_t i) { levels[i] = smallerLevels(scene.textures[i], cutoff[i]); });
  for (std::size_t i = 0; i < scene.textures.size(); ++i) {
    const scene::Texture& texture = scene.textures[i];
    glBindTexture(GL_TEXTURE_2D, names_[i]);
    glTexStorage2D(GL_TEXTURE_2D, static_cast<GLsizei>(levels[i].size() + 1), GL_SRGB8_ALPHA8, texture.width,
                   texture.height);
    uploadLevel(0, texture.width, texture.height, texture.rgba.data());
    int number = 1;
    for (const MipLevel& level : levels[i])
      uploadLevel(number++, level.width, level.height, level.rgba.data());
  }
  const std::uint8_t white[4] = {255, 255, 255, 255};
  glBindTexture(GL_TEXTURE_2D, names_.back());
  glTexStorage2D(GL_TEXTURE_2D, 1, GL_SRGB8_ALPHA8, 1, 1);
  uploadLevel(0, 1, 1, white);
}

Textures::~Textures() {
  glDeleteTextures(static_cast<GLsizei>(names_.size()), names_.data());
}

void Textures::bind(int index) const {
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, index == scene::Material::kNoTexture
                                   ? names_.back()
                                   : names_[static_cast<std::size_t>(index)]);
}

}  // namespace sunlit::render
