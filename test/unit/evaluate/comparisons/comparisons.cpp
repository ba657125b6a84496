#include "sunlit/evaluate/comparisons/comparisons.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <limits>
#include <random>
#include <set>

#include "evaluate/comparisons/pairing.h"
#include "support/temporary_folder.h"

namespace sunlit::evaluate {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

FramesLayout threeHours(std::vector<std::string> names) {
  return {{{"h04", "h12"}, {"h04", "h20"}, {"h12", "h20"}, {"h04", "self_test/h04"}}, std::move(names)};
}

/// D of pair p by method d at a pose: noise about 0.5, and `raised` for the first method.
std::vector<PairRecord> framesOf(const FramesLayout& layout, std::int64_t poses, double raised) {
  std::mt19937_64 generator(5);
  std::normal_distribution<double> noise(0.5, 0.05);
  std::vector<PairRecord> records;
  for (std::int64_t pose = 0; pose < poses; ++pose) {
    for (std::size_t p = 0; p < layout.pairs.size(); ++p) {
      PairRecord record{pose, pose, p, std::vector<DifferenceValue>(layout.differences.size())};
      for (DifferenceValue& value : record.values) value.value = noise(generator);
      record.values[0].value += raised;
      records.push_back(record);
    }
  }
  return records;
}

LocalisationRow query(std::size_t pose, const std::string& stream, const std::string& detector,
                      double error_m) {
  LocalisationRow row;
  row.pose = pose;
  row.map = "h12";
  row.query = stream;
  row.detector = detector;
  if (std::isnan(error_m)) {
    row.result.status = LocalisationStatus::kNoPose;
    return row;
  }
  row.result.status = LocalisationStatus::kLocalised;
  row.result.error_m = error_m;
  row.result.error_deg = 1.0;
  return row;
}

std::string nameOf(const Comparison& row) {
  return row.metric + " " + row.family + " " + row.same + ": " + row.a + ", " + row.b;
}

std::vector<std::string> namesOf(const std::vector<Comparison>& rows) {
  std::vector<std::string> names;
  for (const Comparison& row : rows) names.push_back(nameOf(row));
  return names;
}

TEST(Comparisons, AreBetweenDetectorsOfOnePairAndPairsThatShareAnHour) {
  const FramesLayout layout = threeHours({"boolean_rgb", "sift", "orb"});
  const auto measured = measuredOf(layout, framesOf(layout, 5, 0.0), {"sift", "orb", "surf"});
  const std::vector<std::string> expected = {
      "d methods h04-h12: sift, orb",          "d methods h04-h20: sift, orb",
      "d methods h12-h20: sift, orb",          "d hours boolean_rgb: h04-h12, h04-h20",
      "d hours boolean_rgb: h04-h12, h12-h20", "d hours sift: h04-h12, h04-h20",
      "d hours sift: h04-h12, h12-h20",        "d hours orb: h04-h12, h04-h20",
      "d hours orb: h04-h12, h12-h20",         "d hours boolean_rgb: h04-h20, h12-h20",
      "d hours sift: h04-h20, h12-h20",        "d hours orb: h04-h20, h12-h20"};
  std::vector<std::string> found = namesOf(comparisonsOf(measured, {}).rows);
  EXPECT_EQ(std::set<std::string>(found.begin(), found.end()),
            std::set<std::string>(expected.begin(), expected.end()));
  EXPECT_EQ(found.size(), expected.size()) << "pairs of an hour with itself are not compared";
}

TEST(Comparisons, AreMadeOfMatchesToo) {
  const FramesLayout layout = threeHours({"sift", "orb"});
  VerifiedRecord record{0, 0, 0, std::vector<Verified>(2)};
  record.values[0].matching_score = 0.5;
  record.values[0].precision = kNaN;
  record.values[1].matching_score = 0.25;
  VerifiedRecord next = record;
  next.pose = 1;
  const Comparisons found = comparisonsOf(measuredOf(layout, {record, next}), {});
  const Comparison& score = found.rows.at(0);
  EXPECT_EQ(nameOf(score), "matching_score_3px methods h04-h12: sift, orb");
  EXPECT_EQ(score.test.n, 2u);
  EXPECT_EQ(score.test.mean_difference, 0.25);
  EXPECT_EQ(score.test.p, 0.5);  // two poses: of ++, +−, −+ and −− two are as far
  for (const Comparison& row : found.rows) {
    if (nameOf(row) != "precision_3px methods h04-h12: sift, orb") continue;
    EXPECT_EQ(row.test.n, 0u);
    EXPECT_EQ(row.test.undefined, 2u);
    EXPECT_TRUE(std::isnan(row.p_holm));
  }
}

TEST(Comparisons, OfTwoDrivesAreOfQueriesAtOnePlace) {
  // Along x, a metre a pose; the second begins 3 m further on and half a metre to the side, so that its pose
  // k is where the first's k + 3 is, and ends 10 m further. Its error is always 1 m more than there.
  std::vector<LocalisationRow> rows;
  const auto add = [&](std::size_t pose, const std::string& bag, const Eigen::Vector3d& place,
                       double error_m) {
    rows.push_back(query(pose, bag, "sift", error_m));
    rows.back().drive = bag + ".bag";
    rows.back().truth.translation() = place;
  };
  for (std::size_t k = 0; k < 20; ++k)
    add(k, "dusk", {static_cast<double>(k), 0, 0}, static_cast<double>(k % 5));
  for (std::size_t k = 0; k < 27; ++k)
    add(k, "dawn", {static_cast<double>(k) + 3.0, 0.5, 0}, static_cast<double>((k + 3) % 5) + 1.0);
  const Comparisons found = comparisonsOf(measuredOf(rows), {"h12"});
  const Comparison& row = found.rows.back();
  EXPECT_EQ(nameOf(row), "error_m hours sift: dusk in h12, dawn in h12");
  EXPECT_EQ(row.test.n, 17u);
  EXPECT_EQ(row.unpaired, 3u + 10u);
  EXPECT_EQ(row.test.mean_difference, -1.0);
  EXPECT_EQ(found.paired_by_place,
            std::vector<std::string>{
                "comparisons.csv: dusk in h12 and dawn in h12 have no common numbers of "
                "poses, and were paired by place: 17 pairs, 13 queries without one, nearest to each other "
                "within 5 m"});
  // Who drives back looks the other way; who drives elsewhere is further away.
  for (LocalisationRow& one : rows) {
    if (one.query == "dawn") one.truth.linear() = Eigen::Vector3d(-1, 1, -1).asDiagonal();
  }
  EXPECT_EQ(comparisonsOf(measuredOf(rows), {"h12"}).rows.back().test.n, 0u);
  for (LocalisationRow& one : rows) {
    one.truth.linear().setIdentity();
    if (one.query == "dawn") one.truth.translation().y() = 5.1;
  }
  EXPECT_EQ(comparisonsOf(measuredOf(rows), {"h12"}).rows.back().test.n, 0u);
  // Of one bag they are those of one number, wherever that is.
  for (LocalisationRow& one : rows) one.drive = "both.bag";
  const Comparisons of_one = comparisonsOf(measuredOf(rows), {"h12"});
  EXPECT_EQ(of_one.rows.back().test.n, 20u);
  EXPECT_TRUE(of_one.paired_by_place.empty());
}

/// Places on a lattice of 1 m, of which many are equally far from one another; values are their numbers.
Measured latticeDrive(const std::string& drive, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  std::uniform_int_distribution<int> metres(-20, 20), way(0, 1);
  Measured measured;
  measured.drive = drive;
  for (int i = 0; i < 300; ++i) {
    measured.values.emplace_back(i, i);
    measured.places.push_back({{1.0 * metres(generator), 1.0 * metres(generator), 0.1 * metres(generator)},
                               {way(generator) == 1 ? 1.0 : -1.0, 0.0, 0.0}});
  }
  return measured;
}

/// The first of the nearest, by asking all; −1 where none is near.
int nearestByAskingAll(const MeasuredPlace& place, const std::vector<MeasuredPlace>& all) {
  int nearest = -1;
  double least = kSharedPlace_m * kSharedPlace_m;
  for (std::size_t j = 0; j < all.size(); ++j) {
    const double squared = (all[j].position - place.position).squaredNorm();
    if (all[j].direction != place.direction || (nearest < 0 ? squared > least : squared >= least)) continue;
    nearest = static_cast<int>(j);
    least = squared;
  }
  return nearest;
}

TEST(Comparisons, PairPlacesThatAreNearestToEachOther) {
  const Measured a = latticeDrive("a", 1), b = latticeDrive("b", 2);
  std::vector<double> of_a, of_b;
  for (std::size_t i = 0; i < a.places.size(); ++i) {
    const int there = nearestByAskingAll(a.places[i], b.places);
    if (there < 0) continue;
    if (nearestByAskingAll(b.places[static_cast<std::size_t>(there)], a.places) != static_cast<int>(i))
      continue;
    of_a.push_back(static_cast<double>(i));
    of_b.push_back(there);
  }
  EXPECT_GT(of_a.size(), 50u);
  const Paired paired = pairedOf(a, b);
  EXPECT_EQ(paired.a, of_a);
  EXPECT_EQ(paired.b, of_b);
  EXPECT_EQ(paired.unpaired, 600u - 2 * of_a.size());
}

TEST(Comparisons, CountQueriesThatFail) {
  std::vector<LocalisationRow> rows;
  for (std::size_t pose = 0; pose < 3; ++pose) {
    rows.push_back(query(pose, "h04", "sift", 0.1));
    rows.push_back(query(pose, "h04", "orb", pose == 2 ? kNaN : 0.3));
    if (pose > 0) rows.push_back(query(pose, "h20", "sift", 1.0));
  }
  const std::vector<Comparison> found = comparisonsOf(measuredOf(rows), {"h12"}).rows;
  const std::vector<std::string> expected = {"within_0.25m_2deg methods h04 in h12: sift, orb",
                                             "within_0.25m_2deg hours sift: h04 in h12, h20 in h12",
                                             "within_0.5m_5deg methods h04 in h12: sift, orb",
                                             "within_0.5m_5deg hours sift: h04 in h12, h20 in h12",
                                             "within_5m_10deg methods h04 in h12: sift, orb",
                                             "within_5m_10deg hours sift: h04 in h12, h20 in h12",
                                             "error_m methods h04 in h12: sift, orb",
                                             "error_m hours sift: h04 in h12, h20 in h12"};
  ASSERT_EQ(namesOf(found), expected);
  EXPECT_EQ(found[0].test.mean_difference, 1.0);  // of 3: 0.1 m is within 0.25 m, 0.3 m and no pose are not
  EXPECT_EQ(found[2].test.n, 3u);
  EXPECT_DOUBLE_EQ(found[2].test.mean_difference, 1.0 / 3.0);
  EXPECT_EQ(found[1].unpaired, 1u);
  EXPECT_EQ(found[6].test.n, 2u);
  EXPECT_EQ(found[6].test.failed, 1u);
  EXPECT_DOUBLE_EQ(found[6].test.mean_difference, -0.2);
}

TEST(Comparisons, FindWhatDiffersAndNothingElse) {
  const FramesLayout layout = threeHours({"sift", "orb", "surf"});
  const auto rows =
      comparisonsOf(measuredOf(layout, framesOf(layout, 200, 0.05), layout.differences), {}).rows;
  for (const Comparison& row : rows) {
    const bool differs = row.family == "methods" && row.a == "sift";
    EXPECT_EQ(row.p_holm < 0.05, differs) << nameOf(row) << " " << row.p_holm;
    EXPECT_GE(row.p_holm, row.test.p);
  }
}

TEST(Comparisons, AreCorrectedWithinTheirFamily) {
  const FramesLayout layout = threeHours({"sift", "orb"});
  const auto rows =
      comparisonsOf(measuredOf(layout, framesOf(layout, 200, 0.05), layout.differences), {}).rows;
  std::vector<double> p, adjusted;
  for (const Comparison& row : rows) {
    if (row.family != "methods") continue;
    p.push_back(row.test.p);
    adjusted.push_back(row.p_holm);
  }
  ASSERT_EQ(p.size(), 3u);
  EXPECT_EQ(adjusted, holm(p));
}

/// Pairs of `hours` streams by one method, a pose each.
std::vector<Measured> manyHours(int hours) {
  std::vector<Measured> all;
  for (int a = 0; a < hours; ++a) {
    for (int b = a + 1; b < hours; ++b) {
      const std::string first = "h" + std::to_string(a), second = "h" + std::to_string(b);
      all.push_back({"d", first + "-" + second, {first, second}, "sift", true, {{0, 0.5}, {1, 0.25}}});
    }
  }
  return all;
}

TEST(Comparisons, OfTooManyHoursAreThoseWithTheMap) {
  // 24 hours: each two of the 23 pairs with the map; of all pairs that share an hour 24 · 23 · 22 / 2.
  const Comparisons with_map = comparisonsOf(manyHours(24), {"h12"});
  EXPECT_EQ(with_map.rows.size(), 23u * 22u / 2u);
  ASSERT_EQ(with_map.left_out.size(), 1u);
  EXPECT_NE(with_map.left_out[0].find("5819 comparisons of d between hours that do not share the map"),
            std::string::npos)  // 6072 less these
      << with_map.left_out[0];
  EXPECT_TRUE(comparisonsOf(manyHours(4), {"h12"}).left_out.empty());
  const Comparisons without = comparisonsOf(manyHours(24), {});
  EXPECT_TRUE(without.rows.empty());
  ASSERT_EQ(without.left_out.size(), 1u);
  EXPECT_NE(without.left_out[0].find("6072 comparisons of d between hours"), std::string::npos)
      << without.left_out[0];
  EXPECT_EQ(comparisonsOf(manyHours(24), {"dusk"}).left_out, without.left_out) << "never without a word";
}

TEST(Comparisons, DoNotDependOnTheNumberOfThreads) {
  const FramesLayout layout = threeHours({"sift", "orb", "surf"});
  const auto measured = measuredOf(layout, framesOf(layout, 100, 0.01), layout.differences);
  std::vector<std::string> files;
  for (const std::size_t threads : {1U, 4U}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    const TemporaryFolder folder;
    writeComparisons(folder.file("comparisons.csv"), comparisonsOf(measured, {}).rows);
    files.push_back(contentOf(folder.file("comparisons.csv")));
  }
  EXPECT_EQ(files[0], files[1]);
  EXPECT_EQ(
      files[0].substr(0, files[0].find('\n')),
      "metric,family,same,a,b,n,undefined,failed,unpaired,mean_difference,low,high,p,p_holm,block_length");
}

TEST(Comparisons, StopWhenAsked) {
  EXPECT_THROW(comparisonsOf(manyHours(4), {}, StopToken([] { return true; })), Stopped);
}

}  // namespace
}  // namespace sunlit::evaluate
