#include "scene/stl_faces.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace sunlit::scene {
namespace {

constexpr std::uint64_t kStlHeader_bytes = 84, kStlFace_bytes = 50;

/// Little-endian, behind 80 bytes of whatever the header holds.
std::uint64_t facesOfHeader(const std::string& header) {
  std::uint64_t count = 0;
  for (std::size_t i = kStlHeader_bytes; i-- > kStlHeader_bytes - 4;)
    count = count << 8 | static_cast<std::uint8_t>(header[i]);
  return count;
}

}  // namespace

std::string countedFacesOfStl(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string bytes(kStlHeader_bytes, ' ');
  // Either kind may begin with "solid", but text has no zeros, as numbers of faces have.
  if (!stream.read(bytes.data(), kStlHeader_bytes) || bytes.find('\0') == std::string::npos) return "";
  std::error_code error;
  const std::uint64_t size = std::filesystem::file_size(file, error), faces = facesOfHeader(bytes);
  const std::uint64_t counted = kStlHeader_bytes + faces * kStlFace_bytes;
  if (error || size == counted) return "";
  if (size < counted) {
    throw std::runtime_error(file + ": this STL file is cut short: it counts " + std::to_string(faces) +
                             " faces, and has " + std::to_string((size - kStlHeader_bytes) / kStlFace_bytes));
  }
  bytes.resize(counted);
  stream.read(bytes.data() + kStlHeader_bytes, static_cast<std::streamsize>(counted - kStlHeader_bytes));
  return bytes;
}

}  // namespace sunlit::scene
