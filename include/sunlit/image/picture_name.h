/// What makes chance in one picture independent of that in another.
#pragma once

#include <cstdint>
#include <string>

namespace sunlit::image {

/// Which picture of a series it is: pictures that differ in either have grain that is independent. Drops of
/// rain go by the index alone.
struct PictureName {
  std::int64_t index = 0;
  std::string series;
};

/// Where a picture's random numbers start. What a seed gives stays what it is from version to version.
std::uint64_t randomStart(std::uint64_t seed, const PictureName& name);

}  // namespace sunlit::image
