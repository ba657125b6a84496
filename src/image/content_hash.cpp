#include "sunlit/image/content_hash.h"

#include <array>
#include <cstdio>
#include <fstream>

namespace sunlit::image {

bool ContentHash::addFile(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  std::array<char, 65536> part;
  while (stream.read(part.data(), part.size()) || stream.gcount() > 0)
    addBytes(part.data(), static_cast<std::size_t>(stream.gcount()));
  return stream.is_open() && !stream.bad();
}

std::string ContentHash::text() const {
  const Number value = number();
  char digits[33];
  std::snprintf(digits, sizeof digits, "%016llx%016llx", static_cast<unsigned long long>(value.high),
                static_cast<unsigned long long>(value.low));
  return digits;
}

}  // namespace sunlit::image
