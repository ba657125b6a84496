#include "sunlit/quantity/utf8.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

using namespace sunlit;

namespace {

/// One byte per character, the others as given; "" where it is taken.
std::string refusalOfText(const std::string& text) {
  try {
    utf8Of(text, "a.csv");
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST(Utf8, IsReadWithAndWithoutItsMark) {
  EXPECT_EQ(utf8Of("x,y\n", "a.csv"), "x,y\n");
  EXPECT_EQ(utf8Of("\xEF\xBB\xBFx,y\n", "a.csv"), "x,y\n");
  EXPECT_EQ(utf8Of("\xEF\xBB\xBF", "a.csv"), "");
  EXPECT_EQ(utf8Of("", "a.csv"), "");
  EXPECT_EQ(utf8Of("\xC2\xBF", "a.csv"), "\xC2\xBF") << "a letter that ends as the mark does";
}

TEST(Utf8, IsAskedForWhereTextIsWider) {
  const std::string refused = "a.csv: this is text in UTF-16 or UTF-32: save it as UTF-8";
  for (const std::string& text :
       {std::string("\xFF\xFEx\0", 4), std::string("\xFE\xFF\0x", 4), std::string("\xFF\xFE\0\0x\0\0\0", 8),
        std::string("\0\0\xFE\xFF\0\0\0x", 8), std::string("x\0,\0", 4), std::string("\0x\0,", 4)})
    EXPECT_EQ(refusalOfText(text), refused);
}
