/// COLLADA whose textures want other sets of texture coordinates than the first.
#pragma once

#include <string>

namespace sunlit::scene {

/// `text` such that Assimp knows the sets. Its version 5.2 forgets each <bind_vertex_input>, and then takes
/// the first number in what an effect calls its coordinates: effects call them by the number of the set that
/// their first material binds them to. Of sets with a gap it counts those that are there: primitives get all
/// sets from 0 to their last, those that they lack as their lowest once more. Lines stay where they are.
std::string withKnownSets(const std::string& text);

}  // namespace sunlit::scene
