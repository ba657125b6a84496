/// XXH3 by ourselves, for systems whose xxHash is older than 0.8, which gives some contents other numbers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "sunlit/image/content_hash.h"

namespace sunlit::image {

/// XXH3 with 128 bits and no seed, of all bytes added, in order: what `xxhsum -H2` of xxHash 0.8 prints, on
/// machines whose numbers start with their lowest byte. Source: xxhash.h of xxHash 0.8.1, whose names the
/// steps bear.
class Xxh3 {
 public:
  void add(const void* data, std::size_t size);
  ContentHash::Number number() const;

  static constexpr std::size_t kLanes = 8;
  using Lanes = std::array<std::uint64_t, kLanes>;

 private:
  static constexpr std::size_t kStripe = 64;
  static constexpr std::size_t kBlock = 1024;
  const unsigned char* block() const { return bytes_.data() + kStripe; }
  ContentHash::Number numberOfMany() const;

  Lanes lanes_ = {0xC2B2AE3D,         0x9E3779B185EBCA87, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9,
                  0x85EBCA77C2B2AE63, 0x85EBCA77,         0x27D4EB2F165667C5, 0x9E3779B1};
  std::array<unsigned char, kStripe + kBlock>
      bytes_{};             ///< the end of the last block, and the one that fills
  std::size_t filled_ = 0;  ///< of the latter
  std::uint64_t size_ = 0;  ///< of all
};

}  // namespace sunlit::image
