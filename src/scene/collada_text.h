/// COLLADA that Assimp 5.2 refuses, though XML or COLLADA allows it.
#pragma once

#include <cstddef>
#include <map>
#include <string>

namespace sunlit::scene {

struct ColladaText {
  std::string text;
  std::size_t holes = 0;  ///< of polygons, which are filled: Assimp knows none
};

/// `text` without its animations, each line where it was: Assimp would not check their numbers, and models
/// are seen at rest.
std::string withoutAnimations(const std::string& text);

/// `text` in which no <lines> and <linestrips> count more than stand there, as SketchUp writes them: nobody
/// draws them, and Assimp takes memory for what is counted.
std::string withCountedLines(const std::string& text);

/// Name of the material of what has none in a file that has some.
constexpr const char* kBareMaterial = "sunlit: without a material";

/// `text` in which what has no material, or one that is bound nowhere and is in no library, or whose id is
/// among ColladaEffects::without_effect, has that of this name: Assimp gives it the first of the library, or
/// reads where there is none. Lines stay where they are.
std::string withBareMaterials(const std::string& text,
                              const std::map<std::string, std::string>& without_effect);

/// `text` without blanks before the numbers of <v> and <vcount>: Assimp takes them for zeros, or for the
/// sizes of what it then writes beyond. Lines do not stay where they are.
std::string withWeightsAtOnce(const std::string& text);

/// `text` in which pictures whose <init_from> is empty, as Cinema 4D writes it, have a file that is not
/// there, called as the image is. Lines stay where they are.
std::string withAddressesOfImages(const std::string& text);

/// `text` without comments, without blanks between the tag of a colour and its numbers, and without holes;
/// and pictures without a file have one that is not there, called as the image is.
ColladaText readableCollada(const std::string& text);

}  // namespace sunlit::scene
