#include "sunlit/image/encoded_size.h"

#include <algorithm>
#include <array>

#include "png_chunks.h"

namespace sunlit::image {
namespace {

std::uint32_t bigEndian(const std::uint8_t* bytes, int count) {
  std::uint32_t value = 0;
  for (int i = 0; i < count; ++i) value = value << 8 | bytes[i];
  return value;
}

// Some writers leave more behind the last chunk.
bool hasEndOfPng(const std::uint8_t* bytes, std::size_t size) {
  std::size_t at = kPngSignature.size();
  while (const std::optional<PngChunk> chunk = pngChunkAt(at, bytes, size)) {
    if (chunk->name == "IEND") return true;
    at = chunk->end;
  }
  return false;
}

// PNG (ISO/IEC 15948), 5.2 and 11.2.2: a signature, then the chunk IHDR: width, height, bits and, as flags,
// whether there are colours.
std::optional<EncodedPicture> ofPng(const std::uint8_t* bytes, std::size_t size) {
  constexpr std::array<std::uint8_t, 8> kHeader = {0, 0, 0, 13, 'I', 'H', 'D', 'R'};
  constexpr std::size_t kEnd = 26;
  constexpr std::uint8_t kHasColours = 2;
  if (size < kEnd || !isPng(bytes, size) ||
      !std::equal(kHeader.begin(), kHeader.end(), bytes + kPngSignature.size()))
    return std::nullopt;
  const bool is_grey = (bytes[25] & kHasColours) == 0;
  return EncodedPicture{bigEndian(bytes + 16, 4), bigEndian(bytes + 20, 4), false, is_grey,
                        !hasEndOfPng(bytes, size)};
}

// SOF0 … SOF15 but for DHT (C4), JPG (C8) and DAC (CC), which lie among them.
bool isStartOfFrame(std::uint8_t marker) {
  return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
}

// EOI cannot stand in coded pixels, where a zero follows every FF. It need not be the end of the file: some
// writers fill up with zeros, and phones append a film.
bool hasEndOfImage(const std::uint8_t* begin, const std::uint8_t* end) {
  constexpr std::array<std::uint8_t, 2> kEndOfImage = {0xFF, 0xD9};
  return std::search(begin, end, kEndOfImage.begin(), kEndOfImage.end()) != end;
}

// JPEG (ITU-T T.81), annex B: segments of a marker and their length; a start of frame holds precision,
// height, width and how many channels there are.
std::optional<EncodedPicture> ofJpeg(const std::uint8_t* bytes, std::size_t size) {
  constexpr std::size_t kHead = 10;  // marker, length, precision, height, width, channels
  if (size < 2 || bytes[0] != 0xFF || bytes[1] != 0xD8) return std::nullopt;
  for (std::size_t at = 2; at + kHead <= size;) {
    if (bytes[at] != 0xFF) return std::nullopt;
    const std::uint8_t marker = bytes[at + 1];
    if (marker == 0xFF) {  // fill
      ++at;
      continue;
    }
    if (isStartOfFrame(marker)) {
      return EncodedPicture{bigEndian(bytes + at + 7, 2), bigEndian(bytes + at + 5, 2), true,
                            bytes[at + 9] == 1, !hasEndOfImage(bytes + at, bytes + size)};
    }
    at += 2 + bigEndian(bytes + at + 2, 2);
  }
  return std::nullopt;
}

}  // namespace

std::optional<EncodedPicture> encodedPicture(const std::uint8_t* bytes, std::size_t size) {
  if (const auto png = ofPng(bytes, size)) return png;
  return ofJpeg(bytes, size);
}

}  // namespace sunlit::image
