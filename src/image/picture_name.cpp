#include "sunlit/image/picture_name.h"

#include "random_sequence.h"

namespace sunlit::image {
namespace {

/// FNV-1a of 64 bits (Fowler, Noll, Vo).
std::uint64_t numberOf(const std::string& series) {
  std::uint64_t number = 14695981039346656037u;
  for (const char letter : series) number = (number ^ static_cast<unsigned char>(letter)) * 1099511628211u;
  return number;
}

}  // namespace

std::uint64_t randomStart(std::uint64_t seed, const PictureName& name) {
  const std::uint64_t start =
      mixed(mixed(mixed(seed) ^ static_cast<std::uint64_t>(name.index)) ^ numberOf(name.series));
  return name.drive.empty() ? start : mixed(start ^ numberOf(name.drive));
}

}  // namespace sunlit::image
