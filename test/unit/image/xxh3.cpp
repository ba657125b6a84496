#include "image/xxh3.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace sunlit::image {
namespace {

std::vector<unsigned char> bytes(std::size_t size) {
  std::vector<unsigned char> all(size);
  std::uint32_t state = 1;
  for (unsigned char& byte : all)
    byte = static_cast<unsigned char>((state = state * 1103515245u + 12345u) >> 16);
  return all;
}

ContentHash::Number numberOf(const std::vector<unsigned char>& all, std::size_t size, std::size_t part) {
  Xxh3 hash;
  for (std::size_t at = 0; at < size; at += part) hash.add(all.data() + at, std::min(part, size - at));
  return hash.number();
}

std::string folded(std::size_t part) {
  const std::vector<unsigned char> all = bytes(5000);
  ContentHash hash;
  for (std::size_t size = 0; size <= all.size(); ++size) {
    const ContentHash::Number number = numberOf(all, size, part);
    hash.add(number.high);
    hash.add(number.low);
  }
  return hash.text();
}

// By XXH3_128bits of xxHash 0.8.1, over the numbers of the first 0, 1, … 5000 bytes.
TEST(Xxh3, IsThatOfXxHash08ForEverySizeHoweverItComes) {
  for (const std::size_t part : {5000, 1000, 1024, 77})
    EXPECT_EQ(folded(part), "b6f79ec0f7ad73cba201a1f775823fcb") << part;
}

// Where the system's xxHash is of 0.8, ContentHash is another's word.
TEST(Xxh3, IsTheHashOfContents) {
  const std::vector<unsigned char> all = bytes(1 << 20);
  for (std::size_t size = 0; size <= all.size(); size = size < 2048 ? size + 1 : size + 7777) {
    ContentHash other;
    other.addBytes(all.data(), size);
    EXPECT_TRUE(numberOf(all, size, 65536) == other.number()) << size;
  }
}

}  // namespace
}  // namespace sunlit::image
