/// What Assimp is given of an OBJ file.
#pragma once

#include <assimp/DefaultIOSystem.h>

namespace sunlit::scene {

/// Opens the files that an OBJ file consists of, but no library of materials whose first words are of none:
/// Assimp 5.2 writes them to a material that it does not have. Throws std::runtime_error naming its line,
/// which Assimp hands on.
class ObjInput : public Assimp::DefaultIOSystem {
 public:
  Assimp::IOStream* Open(const char* path, const char* mode = "rb") override;
};

}  // namespace sunlit::scene
