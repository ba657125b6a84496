/// A file for Assimp that is nowhere but in memory.
#pragma once

#include <assimp/MemoryIOWrapper.h>

#include <algorithm>
#include <cstdint>
#include <string>

namespace sunlit::scene {

/// As Assimp's destructor expects it.
inline Assimp::IOStream* streamOf(const std::string& bytes) {
  auto* const copy = new std::uint8_t[bytes.size()];
  std::copy(bytes.begin(), bytes.end(), copy);
  return new Assimp::MemoryIOStream(copy, bytes.size(), true);
}

}  // namespace sunlit::scene
