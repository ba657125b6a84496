#include "sunlit/evaluate/localise/localisation_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sunlit/quantity/frames.h"
#include "support/temporary_folder.h"

namespace sunlit::evaluate {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

LocalisationRow row(std::size_t pose, double error_m, double error_deg) {
  LocalisationRow made;
  made.pose = pose;
  made.stamp_ns = 1500000000 + 100000000 * static_cast<std::int64_t>(pose);
  made.map = "h12";
  made.query = "h04";
  made.detector = "sift";
  made.result.retrieved = 5;
  made.result.has_baseline = true;
  if (std::isnan(error_m)) {
    made.result.status = LocalisationStatus::kNoPose;
  } else {
    made.result.status = LocalisationStatus::kLocalised;
    made.result.error_m = error_m;
    made.result.error_deg = error_deg;
    made.result.relative_deg = error_deg;
    made.result.estimate.inliers = {0, 1, 2};
  }
  return made;
}

constexpr double kNone = LocalisedQuery::kUndefined;

TEST(LocalisationSummary, CountsFailuresInEveryShare) {
  const std::vector<LocalisationRow> rows = {row(0, 0.25, 2.0), row(1, 0.1, 3.0), row(2, 4.0, 1.0),
                                             row(3, kNone, kNone)};
  const std::vector<LocalisationSummary> summaries = summariesOf(rows);
  ASSERT_EQ(summaries.size(), 1u);
  const LocalisationSummary& summary = summaries[0];
  EXPECT_EQ(summary.n, 4u);
  EXPECT_EQ(summary.failures, 1u);
  EXPECT_EQ(summary.within[0].mean, 0.25);  // the bounds themselves are within
  EXPECT_EQ(summary.within[1].mean, 0.5);
  EXPECT_EQ(summary.within[2].mean, 0.75);
  EXPECT_EQ(summary.median_error_m, (0.25 + 4.0) / 2);
  EXPECT_EQ(summary.median_error_deg, 2.5);
  EXPECT_EQ(summary.n_relative, 4u);
}

TEST(LocalisationSummary, HasAnInfiniteMedianWhereHalfAreFailures) {
  const std::vector<LocalisationSummary> summaries =
      summariesOf({row(0, 0.1, 1.0), row(1, 0.2, 1.0), row(2, kNone, kNone), row(3, kNone, kNone)});
  EXPECT_EQ(summaries[0].median_error_m, kInfinity);
  EXPECT_EQ(summariesOf({row(0, 0.1, 1.0), row(1, 0.2, 2.0), row(2, kNone, kNone)})[0].median_error_m, 0.2);
}

TEST(LocalisationSummary, KeepsQueriesAndDetectorsApart) {
  std::vector<LocalisationRow> rows = {row(0, 0.1, 1.0), row(0, 9.0, 1.0), row(1, 0.1, 1.0)};
  rows[1].detector = "orb";
  const std::vector<LocalisationSummary> summaries = summariesOf(rows);
  ASSERT_EQ(summaries.size(), 2u);
  EXPECT_EQ(summaries[0].detector, "sift");
  EXPECT_EQ(summaries[0].n, 2u);
  EXPECT_EQ(summaries[1].within[2].mean, 0.0);
  EXPECT_EQ(summaries[0].within[2].mean, 1.0);
  EXPECT_LT(summaries[0].within[2].ci_low, 0.5) << "two of two are no certainty";
}

TEST(AreaUnderRecall, IsTheTrapezoidOfGlueFactory) {
  // Recall rises to 1/2 at 2 deg along a straight line, to 1 at 4: (2 · 1/4 + 2 · 3/4 + 6 · 1) / 10.
  EXPECT_DOUBLE_EQ(areaUnderRecall({4.0, 2.0}, 10.0), 0.8);
  // One failure: 2 · 1/4 + 8 · 1/2.
  EXPECT_DOUBLE_EQ(areaUnderRecall({2.0, kInfinity}, 10.0), 0.45);
  EXPECT_DOUBLE_EQ(areaUnderRecall({0.0, 0.0}, 5.0), 1.0);
  EXPECT_DOUBLE_EQ(areaUnderRecall({kInfinity}, 5.0), 0.0);
  EXPECT_TRUE(std::isnan(areaUnderRecall({}, 5.0)));
}

TEST(LocalisationFiles, HaveTheirColumns) {
  const TemporaryFolder folder;
  writeLocalisation(folder.file("l.csv"), {row(3, 0.5, 0.25), row(4, kNone, kNone)});
  EXPECT_EQ(contentOf(folder.file("l.csv")),
            "pose,stamp,map,query,detector,error_m,error_deg,inliers,retrieved,status\n"
            "3,1.800000000,h12,h04,sift,0.5,0.25,3,5,localised\n"
            "4,1.900000000,h12,h04,sift,nan,nan,0,5,no_pose\n");
  writeLocalisationSummary(folder.file("s.csv"), summariesOf({row(0, 0.125, 0.0)}));
  EXPECT_EQ(contentOf(folder.file("s.csv")),
            "map,query,detector,n,failures,within_0.25m_2deg,within_0.25m_2deg_low,within_0.25m_2deg_high,"
            "within_0.5m_5deg,within_0.5m_5deg_low,within_0.5m_5deg_high,within_5m_10deg,within_5m_10deg_low,"
            "within_5m_10deg_high,median_error_m,median_error_deg,n_relative,auc_5deg,auc_10deg,auc_20deg\n"
            "h12,h04,sift,1,0,1,nan,nan,1,nan,nan,1,nan,nan,0.125,0,1,1,1,1\n");
  writeLocalisationProblems(folder.file("p.csv"), {{"h12", true, 1500000000, "no depth, none"}});
  EXPECT_EQ(contentOf(folder.file("p.csv")),
            "stream,role,stamp,fault\nh12,map,1.500000000,\"no depth, none\"\n");
}

TEST(LocalisationRows, AreReadAgainAsTheyStand) {
  const TemporaryFolder folder;
  const std::vector<LocalisationRow> rows = {row(0, 0.1 + 0.2, 2.0 / 3.0), row(7, kNone, kNone)};
  writeLocalisation(folder.file("rows.csv"), rows);
  const std::vector<LocalisationRow> read = loadLocalisation(folder.file("rows.csv"));
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[0].result.error_m, 0.1 + 0.2);
  EXPECT_EQ(read[0].result.error_deg, 2.0 / 3.0);
  EXPECT_EQ(read[0].detector, "sift");
  EXPECT_EQ(read[1].pose, 7u);
  EXPECT_EQ(read[1].result.status, LocalisationStatus::kNoPose);
  EXPECT_TRUE(isWithin(read[0].result, kReaches[1]));
  EXPECT_FALSE(isWithin(read[0].result, kReaches[0]));
  EXPECT_FALSE(isWithin(read[1].result, kReaches[2]));
  setContent(folder.file("bad.csv"), contentOf(folder.file("rows.csv")) + "0,0.0,a,b,c,0,0,0,0,0\n");
  EXPECT_THROW(loadLocalisation(folder.file("bad.csv")), std::runtime_error);
}

TEST(LocalisationSummary, IsReadAgainAsItStands) {
  const TemporaryFolder folder;
  std::vector<LocalisationRow> rows = {row(0, 0.25, 2.0), row(1, 0.1, 3.0), row(2, kNone, kNone),
                                       row(3, kNone, kNone)};
  rows.push_back(row(0, 0.1, 1.0));
  rows.back().query = "a, b";
  rows.back().result.has_baseline = false;
  writeLocalisationSummary(folder.file("s.csv"), summariesOf(rows));
  const std::vector<LocalisationSummary> read = loadLocalisationSummary(folder.file("s.csv"));
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[0].failures, 2u);
  EXPECT_EQ(read[0].median_error_m, kInfinity);
  EXPECT_EQ(read[1].query, "a, b");
  writeLocalisationSummary(folder.file("again.csv"), read);
  EXPECT_EQ(contentOf(folder.file("again.csv")), contentOf(folder.file("s.csv")));
  setContent(folder.file("bad.csv"), contentOf(folder.file("s.csv")) + "h12,h04,sift,1\n");
  EXPECT_THROW(loadLocalisationSummary(folder.file("bad.csv")), std::runtime_error);
}

TEST(LocalisationPoses, AreOfTheLinkBesideTheTruth) {
  const TemporaryFolder folder;
  LocalisationRow found = row(0, 0.5, 1.0);
  // Looking along x: the link is not turned, wherever the camera is.
  found.truth = Eigen::Translation3d(1, 2, 3) * linkFromOptical();
  found.result.estimate.map_from_optical = Eigen::Translation3d(1, 2.5, 3) * linkFromOptical();
  LocalisationRow lost = row(1, kNone, kNone);
  lost.truth = Eigen::Translation3d(4, 5, 6) * linkFromOptical();
  writeLocalisationPoses(folder.file("poses.csv"), {found, lost});
  EXPECT_EQ(contentOf(folder.file("poses.csv")),
            "pose,stamp,map,query,detector,x,y,z,qx,qy,qz,qw,true_x,true_y,true_z\n"
            "0,1.500000000,h12,h04,sift,1,2.5,3,0,0,0,1,1,2,3\n"
            "1,1.600000000,h12,h04,sift,nan,nan,nan,nan,nan,nan,nan,4,5,6\n");
}

}  // namespace
}  // namespace sunlit::evaluate
