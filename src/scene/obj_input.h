/// What Assimp is given of an OBJ file.
#pragma once

#include <assimp/DefaultIOSystem.h>

#include <set>
#include <string>
#include <vector>

namespace sunlit::scene {

/// Opens the files that an OBJ file consists of: without a byte order mark; vertices without a colour in
/// white where others have one, since Assimp 5.2 would give them those of others; numbers such as .5 with a
/// 0 before the point, and a second one behind those of `vt` that have one; without comments behind vertices
/// and faces; each library of `mtllib` on a line of its own; libraries of materials as by readableMtl(),
/// whose std::runtime_error Assimp hands on.
class ObjInput : public Assimp::DefaultIOSystem {
 public:
  Assimp::IOStream* Open(const char* path, const char* mode = "rb") override;
};

/// The libraries of materials of an OBJ file, what they do not have, and what of them is lost.
struct ObjLibraries {
  std::vector<std::string> files;
  std::set<std::string> materials;        ///< names of those that they have
  std::vector<std::string> missing;       ///< materials that it uses; each with what is known of why
  std::vector<std::string> not_rendered;  ///< MtlContent::not_rendered
  std::vector<std::string> not_read;      ///< what of its shapes is lost: "WHAT at FILE:LINE"
  std::vector<std::string> placed;        ///< libraries that shift textures or say how often they repeat
};
/// Throws std::runtime_error naming the line where decimals stand behind a comma: Assimp cuts them off there.
ObjLibraries librariesOfObj(const std::string& file);

}  // namespace sunlit::scene
