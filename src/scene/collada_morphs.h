/// Morphs of COLLADA, which Assimp 5.2 does not read as the format has them.
#pragma once

#include <string>
#include <vector>

namespace sunlit::scene {

struct ColladaMorphs {
  std::string text;
  std::vector<std::string> names;  ///< of morphs, once for each node or skin that showed one
};

/// `text` in which the shapes that morphs begin with stand in their place, for nodes and skins. Lines stay
/// where they are.
ColladaMorphs withoutMorphs(const std::string& text);

}  // namespace sunlit::scene
