// What a tool says of the path that it is given.
#include "tools/path_arguments.h"

#include <gtest/gtest.h>

#include <string>

#include "support/temporary_folder.h"

namespace sunlit::tools {
namespace {

TEST(PathArguments, WarnOfASpacingALittleBelowTheDistanceOfWaypoints) {
  const TemporaryFolder folder;
  PathWords words;
  words.file = folder.file("gates.csv");
  setContent(words.file, "0,0\n1.21,0\n2.42,0\n3.63,0\n");
  const auto said = [&words](double spacing_m, int stride) {
    words.sampling.spacing_m = spacing_m;
    words.selection.stride = stride;
    ::testing::internal::CaptureStderr();
    EXPECT_EQ(waypointsOf(words, {}).size(), 4u);
    return ::testing::internal::GetCapturedStderr();
  };
  const std::string told = said(1.2, 1);
  EXPECT_EQ(told.rfind("warning: 2 of 6 poses lie less than a tenth of the spacing behind", 0), 0u) << told;
  EXPECT_EQ(said(1.3, 1), "");
  EXPECT_EQ(said(1.2, 10), "") << "of which they are far apart";
}

}  // namespace
}  // namespace sunlit::tools
