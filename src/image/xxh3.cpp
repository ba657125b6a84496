#include "image/xxh3.h"

#include <algorithm>
#include <cstring>

namespace sunlit::image {
namespace {

using Number = ContentHash::Number;
using Byte = unsigned char;
__extension__ using Wide = unsigned __int128;

constexpr std::uint32_t kPrime32_1 = 0x9E3779B1, kPrime32_2 = 0x85EBCA77;
constexpr std::uint64_t kPrime64_1 = 0x9E3779B185EBCA87, kPrime64_2 = 0xC2B2AE3D27D4EB4F,
                        kPrime64_3 = 0x165667B19E3779F9, kPrime64_4 = 0x85EBCA77C2B2AE63;

constexpr std::size_t kSecretSize = 192;
constexpr std::size_t kSecretOfStripe = 8;  // so far it moves from one stripe to the next
constexpr Byte kSecret[kSecretSize] = {
    0xb8, 0xfe, 0x6c, 0x39, 0x23, 0xa4, 0x4b, 0xbe, 0x7c, 0x01, 0x81, 0x2c, 0xf7, 0x21, 0xad, 0x1c,
    0xde, 0xd4, 0x6d, 0xe9, 0x83, 0x90, 0x97, 0xdb, 0x72, 0x40, 0xa4, 0xa4, 0xb7, 0xb3, 0x67, 0x1f,
    0xcb, 0x79, 0xe6, 0x4e, 0xcc, 0xc0, 0xe5, 0x78, 0x82, 0x5a, 0xd0, 0x7d, 0xcc, 0xff, 0x72, 0x21,
    0xb8, 0x08, 0x46, 0x74, 0xf7, 0x43, 0x24, 0x8e, 0xe0, 0x35, 0x90, 0xe6, 0x81, 0x3a, 0x26, 0x4c,
    0x3c, 0x28, 0x52, 0xbb, 0x91, 0xc3, 0x00, 0xcb, 0x88, 0xd0, 0x65, 0x8b, 0x1b, 0x53, 0x2e, 0xa3,
    0x71, 0x64, 0x48, 0x97, 0xa2, 0x0d, 0xf9, 0x4e, 0x38, 0x19, 0xef, 0x46, 0xa9, 0xde, 0xac, 0xd8,
    0xa8, 0xfa, 0x76, 0x3f, 0xe3, 0x9c, 0x34, 0x3f, 0xf9, 0xdc, 0xbb, 0xc7, 0xc7, 0x0b, 0x4f, 0x1d,
    0x8a, 0x51, 0xe0, 0x4b, 0xcd, 0xb4, 0x59, 0x31, 0xc8, 0x9f, 0x7e, 0xc9, 0xd9, 0x78, 0x73, 0x64,
    0xea, 0xc5, 0xac, 0x83, 0x34, 0xd3, 0xeb, 0xc3, 0xc5, 0x81, 0xa0, 0xff, 0xfa, 0x13, 0x63, 0xeb,
    0x17, 0x0d, 0xdd, 0x51, 0xb7, 0xf0, 0xda, 0x49, 0xd3, 0x16, 0x55, 0x26, 0x29, 0xd4, 0x68, 0x9e,
    0x2b, 0x16, 0xbe, 0x58, 0x7d, 0x47, 0xa1, 0xfc, 0x8f, 0xf8, 0xb8, 0xd1, 0x7a, 0xd0, 0x31, 0xce,
    0x45, 0xcb, 0x3a, 0x8f, 0x95, 0x16, 0x04, 0x28, 0xaf, 0xd7, 0xfb, 0xca, 0xbb, 0x4b, 0x40, 0x7e,
};

std::uint32_t read32(const Byte* at) {
  std::uint32_t value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

std::uint64_t read64(const Byte* at) {
  std::uint64_t value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

/// Of 8 bytes of the secret and the 8 after them.
std::uint64_t secretPair(std::size_t at) {
  return read64(kSecret + at) ^ read64(kSecret + at + 8);
}

std::uint64_t avalanche(std::uint64_t value) {
  value ^= value >> 37;
  value *= 0x165667919E3779F9;
  return value ^ value >> 32;
}

std::uint64_t avalanche64(std::uint64_t value) {
  value = (value ^ value >> 33) * kPrime64_2;
  value = (value ^ value >> 29) * kPrime64_3;
  return value ^ value >> 32;
}

Number product(std::uint64_t a, std::uint64_t b) {
  const Wide value = static_cast<Wide>(a) * b;
  return {static_cast<std::uint64_t>(value >> 64), static_cast<std::uint64_t>(value)};
}

std::uint64_t fold(std::uint64_t a, std::uint64_t b) {
  const Number value = product(a, b);
  return value.high ^ value.low;
}

// XXH3_len_1to3_128b
Number numberOf1To3(const Byte* bytes, std::size_t size) {
  const std::uint32_t low = std::uint32_t{bytes[0]} << 16 | std::uint32_t{bytes[size >> 1]} << 24 |
                            std::uint32_t{bytes[size - 1]} | static_cast<std::uint32_t>(size) << 8;
  const std::uint32_t swapped = __builtin_bswap32(low);
  const std::uint32_t high = swapped << 13 | swapped >> 19;
  return {avalanche64(high ^ std::uint64_t{read32(kSecret + 8) ^ read32(kSecret + 12)}),
          avalanche64(low ^ std::uint64_t{read32(kSecret) ^ read32(kSecret + 4)})};
}

// XXH3_len_4to8_128b
Number numberOf4To8(const Byte* bytes, std::size_t size) {
  const std::uint64_t input = read32(bytes) + (std::uint64_t{read32(bytes + size - 4)} << 32);
  Number value = product(input ^ secretPair(16), kPrime64_1 + (size << 2));
  value.high += value.low << 1;
  value.low ^= value.high >> 3;
  value.low = (value.low ^ value.low >> 35) * 0x9FB21C651E98DF25;
  value.low ^= value.low >> 28;
  return {avalanche(value.high), value.low};
}

// XXH3_len_9to16_128b
Number numberOf9To16(const Byte* bytes, std::size_t size) {
  const std::uint64_t first = read64(bytes), last = read64(bytes + size - 8);
  Number value = product(first ^ last ^ secretPair(32), kPrime64_1);
  value.low += static_cast<std::uint64_t>(size - 1) << 54;
  const std::uint64_t keyed = last ^ secretPair(48);
  value.high += keyed + (keyed & 0xFFFFFFFF) * (kPrime32_2 - 1);
  value.low ^= __builtin_bswap64(value.high);
  const Number mixed = product(value.low, kPrime64_2);
  return {avalanche(mixed.high + value.high * kPrime64_2), avalanche(mixed.low)};
}

// XXH3_mix16B
std::uint64_t mixed16(const Byte* bytes, const Byte* secret) {
  return fold(read64(bytes) ^ read64(secret), read64(bytes + 8) ^ read64(secret + 8));
}

// XXH128_mix32B
void mix32(Number& value, const Byte* first, const Byte* second, const Byte* secret) {
  value.low += mixed16(first, secret);
  value.low ^= read64(second) + read64(second + 8);
  value.high += mixed16(second, secret + 16);
  value.high ^= read64(first) + read64(first + 8);
}

Number finished(const Number& value, std::size_t size) {
  const std::uint64_t high = value.low * kPrime64_1 + value.high * kPrime64_4 + size * kPrime64_2;
  return {0 - avalanche(high), avalanche(value.low + value.high)};
}

// XXH3_len_17to128_128b
Number numberOf17To128(const Byte* bytes, std::size_t size) {
  Number value{0, size * kPrime64_1};
  for (std::size_t pair = (size - 1) / 32 + 1; pair-- > 0;)
    mix32(value, bytes + 16 * pair, bytes + size - 16 * (pair + 1), kSecret + 32 * pair);
  return finished(value, size);
}

// XXH3_len_129to240_128b
Number numberOf129To240(const Byte* bytes, std::size_t size) {
  Number value{0, size * kPrime64_1};
  for (std::size_t pair = 0; pair < 4; ++pair)
    mix32(value, bytes + 32 * pair, bytes + 32 * pair + 16, kSecret + 32 * pair);
  value = {avalanche(value.high), avalanche(value.low)};
  for (std::size_t pair = 4; pair < size / 32; ++pair)
    mix32(value, bytes + 32 * pair, bytes + 32 * pair + 16, kSecret + 3 + 32 * (pair - 4));
  mix32(value, bytes + size - 16, bytes + size - 32, kSecret + 136 - 17 - 16);
  return finished(value, size);
}

Number numberOfFew(const Byte* bytes, std::size_t size) {
  if (size == 0) return {avalanche64(secretPair(80)), avalanche64(secretPair(64))};
  if (size <= 3) return numberOf1To3(bytes, size);
  if (size <= 8) return numberOf4To8(bytes, size);
  if (size <= 16) return numberOf9To16(bytes, size);
  return size <= 128 ? numberOf17To128(bytes, size) : numberOf129To240(bytes, size);
}

constexpr std::size_t kFew = 240;

// XXH3_accumulate_512
void accumulate(Xxh3::Lanes& lanes, const Byte* stripe, const Byte* secret) {
  for (std::size_t i = 0; i < Xxh3::kLanes; ++i) {
    const std::uint64_t value = read64(stripe + 8 * i);
    const std::uint64_t keyed = value ^ read64(secret + 8 * i);
    lanes[i ^ 1] += value;
    lanes[i] += (keyed & 0xFFFFFFFF) * (keyed >> 32);
  }
}

// XXH3_scrambleAcc
void scramble(Xxh3::Lanes& lanes, const Byte* secret) {
  for (std::size_t i = 0; i < Xxh3::kLanes; ++i)
    lanes[i] = (lanes[i] ^ lanes[i] >> 47 ^ read64(secret + 8 * i)) * kPrime32_1;
}

// XXH3_mergeAccs
std::uint64_t merged(const Xxh3::Lanes& lanes, const Byte* secret, std::uint64_t start) {
  for (std::size_t i = 0; i < Xxh3::kLanes; i += 2)
    start += fold(lanes[i] ^ read64(secret + 8 * i), lanes[i + 1] ^ read64(secret + 8 * i + 8));
  return avalanche(start);
}

}  // namespace

void Xxh3::add(const void* data, std::size_t size) {
  const Byte* bytes = static_cast<const Byte*>(data);
  size_ += size;
  while (size > 0) {
    if (filled_ == kBlock) {  // only now: the last block of all is dealt with in another way
      for (std::size_t at = 0; at < kBlock; at += kStripe)
        accumulate(lanes_, block() + at, kSecret + at / kStripe * kSecretOfStripe);
      scramble(lanes_, kSecret + kSecretSize - kStripe);
      std::memcpy(bytes_.data(), bytes_.data() + kBlock, kStripe);
      filled_ = 0;
    }
    const std::size_t part = std::min(size, kBlock - filled_);
    std::memcpy(bytes_.data() + kStripe + filled_, bytes, part);
    filled_ += part;
    bytes += part;
    size -= part;
  }
}

Number Xxh3::number() const {
  return size_ <= kFew ? numberOfFew(block(), filled_) : numberOfMany();
}

Number Xxh3::numberOfMany() const {
  constexpr std::size_t kLastSecret = 7, kMergeSecret = 11;
  Lanes lanes = lanes_;
  for (std::size_t stripe = 0; stripe < (filled_ - 1) / kStripe; ++stripe)
    accumulate(lanes, block() + stripe * kStripe, kSecret + stripe * kSecretOfStripe);
  accumulate(lanes, block() + filled_ - kStripe, kSecret + kSecretSize - kStripe - kLastSecret);
  return {merged(lanes, kSecret + kSecretSize - kStripe - kMergeSecret, ~(size_ * kPrime64_2)),
          merged(lanes, kSecret + kMergeSecret, size_ * kPrime64_1)};
}

}  // namespace sunlit::image
