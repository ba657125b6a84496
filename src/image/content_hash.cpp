#include "sunlit/image/content_hash.h"

#include <xxhash.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <new>

namespace sunlit::image {

ContentHash::ContentHash() : state_(XXH3_createState()) {
  if (!state_) throw std::bad_alloc();
  XXH3_128bits_reset(state_.get());
}
ContentHash::ContentHash(ContentHash&&) noexcept = default;
ContentHash& ContentHash::operator=(ContentHash&&) noexcept = default;
ContentHash::~ContentHash() = default;

void ContentHash::Free::operator()(XXH3_state_s* state) const {
  XXH3_freeState(state);
}

void ContentHash::addBytes(const void* data, std::size_t size) {
  if (size > 0) XXH3_128bits_update(state_.get(), data, size);
}

void ContentHash::addFile(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  std::array<char, 65536> part;
  while (stream.read(part.data(), part.size()) || stream.gcount() > 0)
    addBytes(part.data(), static_cast<std::size_t>(stream.gcount()));
}

ContentHash::Number ContentHash::number() const {
  const XXH128_hash_t hash = XXH3_128bits_digest(state_.get());
  return {hash.high64, hash.low64};
}

std::string ContentHash::text() const {
  const Number value = number();
  char digits[33];
  std::snprintf(digits, sizeof digits, "%016llx%016llx", static_cast<unsigned long long>(value.high),
                static_cast<unsigned long long>(value.low));
  return digits;
}

}  // namespace sunlit::image
