// Built everywhere, and by another name, since most systems have ROS's own beside it.
#define diagnostic_updater diagnostic_updater_absent
#include "ros/diagnostic_updater_absent/diagnostic_updater/diagnostic_updater.h"

#include <gtest/gtest.h>

#include <string>

namespace {

using Status = diagnostic_updater_absent::DiagnosticStatusWrapper;

std::string merged(Status::_level_type level, Status::_level_type other) {
  Status status;
  status.summary(level, "first");
  status.mergeSummary(other, "second");
  return std::to_string(int(status.level)) + " " + status.message;
}

}  // namespace

TEST(DiagnosticUpdaterAbsent, KeepsTheWorseOfTwoSummariesAndJoinsWhatIsWrong) {
  EXPECT_EQ(merged(Status::OK, Status::OK), "0 first");
  EXPECT_EQ(merged(Status::OK, Status::WARN), "1 second");
  EXPECT_EQ(merged(Status::WARN, Status::OK), "1 first");
  EXPECT_EQ(merged(Status::ERROR, Status::WARN), "2 first; second");
}

TEST(DiagnosticUpdaterAbsent, WritesValuesAndFormattedTexts) {
  Status status;
  status.add("poses", 3);
  status.addf("share", "%.1f %%", 50.0);
  status.summaryf(Status::WARN, "%d of %d", 1, 2);
  ASSERT_EQ(status.values.size(), 2u);
  EXPECT_EQ(status.values[0].value, "3");
  EXPECT_EQ(status.values[1].value, "50.0 %");
  EXPECT_EQ(status.message, "1 of 2");
}
