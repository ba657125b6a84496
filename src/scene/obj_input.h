/// What Assimp is given of an OBJ file.
#pragma once

#include <assimp/DefaultIOSystem.h>

#include <string>
#include <vector>

namespace sunlit::scene {

/// Opens the files that an OBJ file consists of: without a byte order mark, and textures without where they
/// are shifted and how often they repeat (-o, -s, -t of MTL), of which Assimp 5.2 may take their names for a
/// part; with a white Kd beside pictures of colour that have none, and white vertices beside coloured ones.
/// No library of materials whose first words are of none: Assimp writes them to a material that it does not
/// have. Throws std::runtime_error naming its line, which Assimp hands on.
class ObjInput : public Assimp::DefaultIOSystem {
 public:
  Assimp::IOStream* Open(const char* path, const char* mode = "rb") override;
};

/// What of an OBJ file's looks is lost.
struct ObjLosses {
  std::vector<std::string> materials;  ///< that it uses, but no library has; each with what is known of why
  std::vector<std::string> mirroring;  ///< that libraries give a picture of what they mirror, by `refl`
  std::vector<std::string> placed;     ///< libraries that shift textures or say how often they repeat
};
/// Throws std::runtime_error naming the line where decimals stand behind a comma: Assimp cuts them off there.
ObjLosses lossesOfObj(const std::string& file);

}  // namespace sunlit::scene
