#include "scene/mesh_texture.h"

#include <assimp/material.h>

#include "scene/mesh_file.h"
#include "scene/obj_lines.h"

namespace sunlit::scene {

namespace {

Found foundAs(const std::string& name, const MeshFileContext& context) {
  Found found = context.finder.findTexture(name, context.file);
  for (const std::string& library : context.libraries) {
    if (found.file) break;
    if (const Found beside = context.finder.findTexture(name, library); beside.file) found = beside;
  }
  return found;
}

Wrap wrapOf(const aiMaterial& source, const char* key, aiTextureType type) {
  int mode = aiTextureMapMode_Wrap;
  source.Get(key, static_cast<unsigned>(type), 0, mode);
  return mode == aiTextureMapMode_Clamp || mode == aiTextureMapMode_Decal ? Wrap::kClamp
         : mode == aiTextureMapMode_Mirror                                ? Wrap::kMirror
                                                                          : Wrap::kRepeat;
}

}  // namespace

Wraps wrapsOf(const aiMaterial& source, aiTextureType type) {
  return {wrapOf(source, _AI_MATKEY_MAPPINGMODE_U_BASE, type),
          wrapOf(source, _AI_MATKEY_MAPPINGMODE_V_BASE, type)};
}

std::optional<std::string> textureFile(const std::string& name, const MeshFileContext& context) {
  Found found = foundAs(name, context);
  if (!found.file && extensionOf(context.file) == ".obj") {
    const std::string commented = withoutComment(name);  // unless that is a part of the name
    const std::size_t end = commented.find_last_not_of(" \t");
    if (commented != name && end != std::string::npos) found = foundAs(commented.substr(0, end + 1), context);
  }
  if (!found.file) context.builder.warn(kMissingTextures, name + " of " + context.file);
  if (found.file && found.other_case)
    context.builder.warn(kSpeltOtherwise, name + " of " + context.file + " is " + *found.file);
  return found.file;
}

int addMeshTexture(const std::string& name, const aiScene& scene, const MeshFileContext& context,
                   const Wraps& wraps) {
  if (const aiTexture* embedded = scene.GetEmbeddedTexture(name.c_str())) {
    if (embedded->mHeight != 0) {
      context.builder.warn(
          "textures are embedded as raw texels, which are not read, neutral ones take their place",
          name + " of " + context.file);
      return Material::kNoTexture;
    }
    const auto* begin = reinterpret_cast<const std::uint8_t*>(embedded->pcData);
    const std::string label = embedded->mFilename.length > 0 ? embedded->mFilename.C_Str() : "";
    return context.builder.textureFromBytes(
        context.file + ": texture " + name + (label.empty() ? "" : " " + label),
        {begin, begin + embedded->mWidth}, wraps);
  }
  const std::optional<std::string> file = textureFile(name, context);
  return file ? context.builder.textureFromFile(*file, wraps) : Material::kNoTexture;
}

std::string nameOf(const aiMaterial& source) {
  aiString name;
  source.Get(AI_MATKEY_NAME, name);
  return name.C_Str();
}

}  // namespace sunlit::scene
