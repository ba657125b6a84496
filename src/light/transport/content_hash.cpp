#include "light/transport/content_hash.h"

#include <algorithm>
#include <cstdio>
#include <cstring>

namespace sunlit::light {

/// Two chains of multiply and xor-shift, the mixing step of SplitMix64 (Steele, Lea, Flood 2014).
void ContentHash::addWord(std::uint64_t word) {
  a_ = (a_ ^ word) * 0xbf58476d1ce4e5b9ull;
  a_ ^= a_ >> 27;
  b_ = (b_ + word) * 0x94d049bb133111ebull;
  b_ ^= b_ >> 31;
}

void ContentHash::addBytes(const void* data, std::size_t size) {
  const auto* bytes = static_cast<const unsigned char*>(data);
  addWord(size);
  for (std::size_t at = 0; at < size; at += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes + at, std::min<std::size_t>(8, size - at));
    addWord(word);
  }
}

std::string ContentHash::text() const {
  char text[33];
  std::snprintf(text, sizeof(text), "%016llx%016llx", static_cast<unsigned long long>(a_),
                static_cast<unsigned long long>(b_));
  return text;
}

}  // namespace sunlit::light
