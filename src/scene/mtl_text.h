/// Libraries of materials of OBJ files (MTL).
#pragma once

#include <set>
#include <string>
#include <vector>

namespace sunlit::scene {

/// The library at `path`, whose content is `text`, such that Assimp 5.2 reads it: textures without where they
/// are shifted and how often they repeat (-o, -s, -t), and without -cc, of which it may take their names for
/// a part; with a white Kd beside pictures of colour that have none, and lone numbers of a colour for each of
/// its three channels; without lines at which it would give up the whole file:
/// `aniso`, `anisor`, `decal`, `-halo` of `d`, and colours by `xyz` or `spectral`. Throws std::runtime_error
/// naming the line where the first word is of no material: Assimp writes it to one that it does not have.
std::string readableMtl(const std::string& text, const std::string& path);

/// What there is in a library, and what of it is lost.
struct MtlContent {
  std::set<std::string> materials;        ///< names
  std::vector<std::string> not_rendered;  ///< "MATERIAL of PATH: WHAT"
  bool is_placed = false;                 ///< shifts textures or says how often they repeat
};
MtlContent contentOfMtl(const std::string& text, const std::string& path);

}  // namespace sunlit::scene
