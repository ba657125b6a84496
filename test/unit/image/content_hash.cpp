#include "sunlit/image/content_hash.h"

#include <gtest/gtest.h>

#include "support/temporary_folder.h"

namespace sunlit::image {
namespace {

std::string hashOf(const std::string& text) {
  ContentHash hash;
  hash.addBytes(text.data(), text.size());
  return hash.text();
}

// As `xxhsum -H2` (xxHash 0.8) prints them.
TEST(ContentHash, IsThePublishedOne) {
  EXPECT_EQ(hashOf(""), "99aa06d3014798d86001c324468d497f");
  EXPECT_EQ(hashOf("a"), "a96faf705af16834e6c632b61e964e1f");
}

TEST(ContentHash, IsOfAllBytesHoweverTheyCome) {
  const std::string text(200000, 'x');
  ContentHash in_parts;
  in_parts.addBytes(text.data(), 1);
  in_parts.addBytes(text.data(), 150000);
  in_parts.addBytes(text.data(), 0);
  in_parts.addBytes(text.data(), 49999);
  EXPECT_EQ(in_parts.text(), hashOf(text));
  const TemporaryFolder folder;
  setContent(folder.file("a"), text);
  ContentHash of_file;
  EXPECT_TRUE(of_file.addFile(folder.file("a")));
  EXPECT_EQ(of_file.text(), hashOf(text));
  EXPECT_FALSE(of_file.addFile(folder.file("gone")));
  EXPECT_FALSE(of_file.addFile(folder.file("")));
}

TEST(ContentHash, TellsWhereOneListEnds) {
  ContentHash one, other;
  one.add(std::vector<int>{1, 2});
  one.add(std::vector<int>{3});
  other.add(std::vector<int>{1});
  other.add(std::vector<int>{2, 3});
  EXPECT_TRUE(one.number() != other.number());
}

TEST(ContentHash, GoesOnWhereItIsMovedTo) {
  ContentHash first;
  first.addBytes("a", 1);
  ContentHash second = std::move(first);
  second.addBytes("b", 1);
  EXPECT_EQ(second.text(), hashOf("ab"));
}

}  // namespace
}  // namespace sunlit::image
