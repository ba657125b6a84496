#include "sunlit/quantity/fingerprint.h"

#include <gtest/gtest.h>

#include <string>

namespace sunlit {
namespace {

std::uint64_t fingerprintOf(const std::string& text) {
  Fingerprint print;
  for (const char letter : text) print.add(static_cast<unsigned char>(letter));
  return print.value();
}

TEST(Fingerprint, IsThePublishedOne) {
  // Test vectors of draft-eastlake-fnv, 64 bits.
  EXPECT_EQ(fingerprintOf(""), 0xcbf29ce484222325u);
  EXPECT_EQ(fingerprintOf("a"), 0xaf63dc4c8601ec8cu);
  EXPECT_EQ(fingerprintOf("foobar"), 0x85944171f73967e8u);
}

TEST(Fingerprint, IsWrittenInSixteenDigits) {
  EXPECT_EQ(Fingerprint().text(), "cbf29ce484222325");
}

}  // namespace
}  // namespace sunlit
