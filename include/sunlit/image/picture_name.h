/// What makes chance in one picture independent of that in another.
#pragma once

#include <cstdint>
#include <string>

namespace sunlit::image {

/// Which picture of a series it is: pictures that differ in any of these have grain that is independent.
/// Drops of rain go by index and drive alone. Whoever takes pictures of other places by the same index and
/// series, as a second drive along a path does, names the drive.
struct PictureName {
  std::int64_t index = 0;
  std::string series = {};
  std::string drive = {};
};

/// Where a picture's random numbers start. What a seed gives stays what it is from version to version.
std::uint64_t randomStart(std::uint64_t seed, const PictureName& name);

}  // namespace sunlit::image
