#include "sunlit/quantity/comma_list.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

namespace sunlit {
namespace {

TEST(CommaLists, HaveACommaBetweenTwoNamesOfWhateverContainer) {
  EXPECT_EQ(commaList(std::vector<std::string>{}), "");
  EXPECT_EQ(commaList(std::vector<std::string>{"sift"}), "sift");
  EXPECT_EQ(commaList(std::vector<std::string>{"sift", "orb", "brisk"}), "sift, orb, brisk");
  EXPECT_EQ(commaList(std::set<std::string>{"b", "a"}), "a, b");
}

TEST(CommaLists, ShowThatANameIsEmpty) {
  EXPECT_EQ(commaList(std::vector<std::string>{"", "orb"}), ", orb");
}

}  // namespace
}  // namespace sunlit
