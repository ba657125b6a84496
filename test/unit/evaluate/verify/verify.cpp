#include "sunlit/evaluate/verify/verify.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>

#include "sunlit/evaluate/differences/feature_difference.h"
#include "sunlit/evaluate/verify/verified_file.h"
#include "support/message_of.h"
#include "support/temporary_folder.h"

namespace sunlit::evaluate {
namespace {

struct Point {
  float x;
  float y;
  float descriptor;  ///< one value, so that distances can be read off
};

Features featuresOf(const std::vector<Point>& points) {
  Features features;
  features.descriptors = cv::Mat(static_cast<int>(points.size()), 1, CV_32F);
  for (std::size_t i = 0; i < points.size(); ++i) {
    features.key_points.emplace_back(points[i].x, points[i].y, 1.0F);
    features.descriptors.at<float>(static_cast<int>(i)) = points[i].descriptor;
  }
  return features;
}

/// Points on one line whose descriptors do not matter.
Features pointsAt(const std::vector<float>& places) {
  std::vector<Point> points;
  for (const float x : places) points.push_back({x, 10.0F, x});
  return featuresOf(points);
}

const PictureSizes kHundreds{{100, 100}, {100, 100}};
const PointMaps kSame = identityMaps({100, 100});

Verified verified(const Features& a, const Features& b, const PointMaps& maps = kSame) {
  return verify({a, b, twoNearestBothWays(a.descriptors, b.descriptors, cv::NORM_L2)}, maps, {});
}

double repeatability(const std::vector<float>& a, const std::vector<float>& b,
                     const PointMaps& maps = kSame) {
  return verified(pointsAt(a), pointsAt(b), maps).repeatability;
}

PointMaps shifted(double x) {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  matrix(0, 2) = x;
  return homographyMaps(matrix, kHundreds);
}

TEST(Repeatability, IsTheShareOfCommonPointsWithAPartnerWithinThreePixels) {
  // 97 is shown at 102, and 2 would be at −3: neither is common. 10 is shown at 15 and 20 at 25, where 28 is
  // just near enough.
  const Verified v = verified(pointsAt({10, 20, 97}), pointsAt({15, 28, 2}), shifted(5.0));
  EXPECT_EQ(v.common_a, 2u);
  EXPECT_EQ(v.common_b, 2u);
  EXPECT_EQ(v.repeatability, 1.0);
  EXPECT_EQ(repeatability({10, 20, 97}, {15, 28.25F, 2}, shifted(5.0)), 0.5);
  // Two of three, and two of two.
  EXPECT_EQ(repeatability({10, 20, 50}, {15, 25}, shifted(5.0)), (2.0 / 3.0 + 1.0) / 2.0);
}

TEST(Repeatability, MeasuresInThePixelsOfTheOtherPicture) {
  const PointMaps twice =
      homographyMaps(Eigen::Vector3d(2.0, 2.0, 1.0).asDiagonal(), {{100, 100}, {200, 200}});
  const auto at = [](float place) { return featuresOf({{place, place, 0.0F}}); };
  EXPECT_EQ(verified(at(10), at(22), twice).repeatability, 1.0);  // 2.8 px in b, 1.4 px in a
  EXPECT_EQ(verified(at(10), at(24), twice).repeatability, 0.5);  // 5.7 px in b, 2.8 px in a
  EXPECT_EQ(verified(at(10), at(26), twice).repeatability, 0.0);  // 8.5 px in b, 4.2 px in a
}

TEST(Repeatability, GivesEachPartnerToOneTheNearestPairFirst) {
  EXPECT_EQ(repeatability({10, 12}, {11}), (0.5 + 1.0) / 2.0);
  // 13 takes 12, at 1 px; so 10 has none, though both would have one if 13 took 15.5.
  EXPECT_EQ(repeatability({10, 13}, {12, 15.5F}), 0.5);
}

TEST(Repeatability, GivesAPartnerThatIsEquallyNearToTheFirst) {
  EXPECT_EQ(repeatability({10, 12}, {11, 14}), 1.0);  // 10 takes 11, 12 takes 14
  EXPECT_EQ(repeatability({12, 10}, {11, 14}), 0.5);  // 12 takes 11
}

TEST(Repeatability, IsTheSameBothWays) {
  cv::RNG generator(5);
  std::vector<Point> points[2];
  for (auto& some : points) {
    for (int i = 0; i < 150; ++i)
      some.push_back({static_cast<float>(generator.uniform(0, 100)),
                      static_cast<float>(generator.uniform(0, 100)), 0.0F});  // whole pixels, so many ties
  }
  const Features a = featuresOf(points[0]);
  const Features b = featuresOf(points[1]);
  const PointMaps there = shifted(7.0);
  const PointMaps back{there.a_from_b, there.b_from_a};
  const double value = verified(a, b, there).repeatability;
  EXPECT_EQ(value, verified(b, a, back).repeatability);
  EXPECT_GT(value, 0.1);
  EXPECT_LT(value, 0.9);
}

/// A second opinion on partners: all pairs, the nearest of what is left again and again.
double slowShare(const std::vector<cv::Point2d>& places, std::vector<cv::Point2d> points) {
  std::vector<cv::Point2d> left = places;
  while (true) {
    double least = 9.0;
    std::size_t nearest[2] = {left.size(), 0};
    for (std::size_t i = 0; i < left.size(); ++i) {
      for (std::size_t j = 0; j < points.size(); ++j) {
        const cv::Point2d apart = left[i] - points[j];
        if (apart.dot(apart) < least || (apart.dot(apart) == least && nearest[0] == left.size())) {
          least = apart.dot(apart);
          nearest[0] = i;
          nearest[1] = j;
        }
      }
    }
    if (nearest[0] == left.size()) break;
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(nearest[0]));
    points.erase(points.begin() + static_cast<std::ptrdiff_t>(nearest[1]));
  }
  return 1.0 - static_cast<double>(left.size()) / static_cast<double>(places.size());
}

TEST(Repeatability, IsThatOfASlowSearch) {
  cv::RNG generator(9);
  std::vector<Point> points[2];
  std::vector<cv::Point2d> places[2];
  for (int picture : {0, 1}) {
    for (int i = 0; i < 200; ++i) {
      // Quarters of pixels: exact, and some equally far.
      const cv::Point2f at(generator.uniform(0, 396) / 4.0F, generator.uniform(0, 396) / 4.0F);
      points[picture].push_back({at.x, at.y, 0.0F});
      const bool is_common = picture == 0 ? at.x + 7.0F < 99.5F : at.x - 7.0F >= -0.5F;
      if (is_common) places[picture].emplace_back(at);
    }
  }
  const Verified v = verified(featuresOf(points[0]), featuresOf(points[1]), shifted(7.0));
  ASSERT_EQ(v.common_a, places[0].size());
  ASSERT_EQ(v.common_b, places[1].size());
  for (cv::Point2d& place : places[0]) place.x += 7.0;
  // What is left over is rounded once, as the share itself is.
  EXPECT_NEAR(v.repeatability, (slowShare(places[0], places[1]) + slowShare(places[1], places[0])) / 2.0,
              1e-15);
}

TEST(Repeatability, CountsAsOpenCvDoesWhereDistanceAndOverlapAgree) {
  // Points 60 px apart, of 30 px, so that none overlaps another's; 40 found in a, and of these 29 in b, moved
  // by less than a pixel, and 5 of its own. Shown 4 px to the right.
  cv::Mat matrix = cv::Mat::eye(3, 3, CV_64F);
  matrix.at<double>(0, 2) = 4.0;
  std::vector<cv::KeyPoint> a;
  std::vector<cv::KeyPoint> b;
  for (int i = 0; i < 45; ++i) {
    const cv::Point2f at(60.0F + 60.0F * (i % 9), 60.0F + 60.0F * (i / 9));
    const cv::Point2f moved = at + cv::Point2f(4.5F, i % 3 / 4.0F);
    if (i < 40) a.emplace_back(at, 30.0F);
    if (i >= 11) b.emplace_back(moved, 30.0F);
  }
  Features of[2];
  for (int picture : {0, 1}) {
    of[picture].key_points = picture == 0 ? a : b;
    of[picture].descriptors = cv::Mat::zeros(static_cast<int>(of[picture].key_points.size()), 1, CV_32F);
  }
  float repeatability = 0.0F;
  int partners = 0;
  const cv::Mat picture(400, 700, CV_8U, cv::Scalar(0));
  cv::evaluateFeatureDetector(picture, picture, matrix, &a, &b, repeatability, partners);
  EXPECT_EQ(partners, 29);
  Eigen::Matrix3d shift = Eigen::Matrix3d::Identity();
  shift(0, 2) = 4.0;
  const Verified v = verified(of[0], of[1], homographyMaps(shift, {{700, 400}, {700, 400}}));
  EXPECT_EQ(v.repeatability, (partners / 40.0 + partners / 34.0) / 2.0);
}

// Three features each; matched 0.5, 2 and 60 px off.
const std::vector<Point> kThreeOfA = {{10, 0, 0}, {20, 0, 10}, {30, 0, 20}};
const std::vector<Point> kThreeOfB = {{10.5F, 0, 0}, {22, 0, 10}, {90, 0, 21}};

TEST(MatchingAccuracy, IsTheShareOfMutualMatchesWithinSoManyPixels) {
  const Verified v = verified(featuresOf(kThreeOfA), featuresOf(kThreeOfB));
  EXPECT_EQ(v.mutual_matches, 3u);
  EXPECT_EQ(v.matching_accuracy[0], 1.0 / 3.0);
  for (std::size_t step = 1; step < kAccuracySteps; ++step)
    EXPECT_EQ(v.matching_accuracy[step], 2.0 / 3.0) << step;
}

TEST(MatchingAccuracy, LeavesOutWhatIsNotMutual) {
  // Both 0 and 1 of a are nearest to 0 of b, which is nearer to the first.
  const Verified v = verified(featuresOf({{10, 0, 0}, {50, 0, 1}}), featuresOf({{10, 0, 0}, {90, 0, 100}}));
  EXPECT_EQ(v.mutual_matches, 1u);
  EXPECT_EQ(v.matching_accuracy[0], 1.0);
}

TEST(MatchingAccuracy, CountsMatchesOfPointsOutsideTheCommonPartAsWrong) {
  const PointMaps maps = {
      [](const Eigen::Vector2d& point) { return point.x() > 15.0 ? std::nullopt : std::optional(point); },
      kSame.a_from_b};
  const Verified v = verified(featuresOf(kThreeOfA), featuresOf(kThreeOfB), maps);
  EXPECT_EQ(v.common_a, 1u);
  EXPECT_EQ(v.matching_accuracy[9], 1.0 / 3.0);
}

TEST(MatchingAccuracy, KnowsTheNearestOfASingleFeature) {
  const Features one = featuresOf({{30, 0, 20}});
  EXPECT_EQ(verified(one, one).mutual_matches, 1u);
  for (const Verified& v : {verified(featuresOf(kThreeOfA), one), verified(one, featuresOf(kThreeOfA))}) {
    EXPECT_EQ(v.mutual_matches, 1u);
    EXPECT_EQ(v.matching_accuracy[0], 1.0);
    EXPECT_EQ(v.matching_score, 1.0);
  }
}

TEST(MatchingScore, IsTheShareOfTheFewerFeatures) {
  EXPECT_EQ(verified(featuresOf(kThreeOfA), featuresOf(kThreeOfB)).matching_score, 2.0 / 3.0);
  auto more = kThreeOfA;
  more.push_back({60, 60, 500});
  EXPECT_EQ(verified(featuresOf(more), featuresOf(kThreeOfB)).matching_score, 2.0 / 3.0);
  EXPECT_EQ(verified(featuresOf(more), featuresOf({kThreeOfB[0], kThreeOfB[1]})).matching_score, 1.0);
  // Also of those that are not common.
  const Verified v =
      verified(featuresOf({{10, 0, 0}, {80, 0, 10}}), featuresOf({{40, 0, 0}, {2, 0, 10}}), shifted(30.0));
  EXPECT_EQ(v.common_a, 1u);
  EXPECT_EQ(v.common_b, 1u);
  EXPECT_EQ(v.matching_score, 1.0 / 2.0);
}

TEST(PrecisionAndRecall, AreSharesOfAcceptedMatchesAndOfCorrespondences) {
  // All three pass: 0 against 10 or more, 1 against 10. 30 of a has nothing near it in b.
  const Verified v = verified(featuresOf(kThreeOfA), featuresOf(kThreeOfB));
  EXPECT_EQ(v.difference.matches, 3u);
  EXPECT_EQ(v.correspondences, 2u);
  EXPECT_EQ(v.precision, 2.0 / 3.0);
  EXPECT_EQ(v.recall, 1.0);
  // With a third feature of b at 30, found only as a decoy by its descriptor.
  auto with_third = kThreeOfB;
  with_third.push_back({30, 0, 26});
  const Verified w = verified(featuresOf(kThreeOfA), featuresOf(with_third));
  EXPECT_EQ(w.difference.matches, 3u);  // 20: 1 against 6
  EXPECT_EQ(w.correspondences, 3u);
  EXPECT_EQ(w.recall, 2.0 / 3.0);
}

TEST(PrecisionAndRecall, CountEachFeatureOfAThatSharesOneOfB) {
  const Verified v = verified(featuresOf({{10, 0, 0}, {11, 0, 1}}), featuresOf({{10, 0, 0}, {90, 0, 100}}));
  EXPECT_EQ(v.difference.matches, 2u);
  EXPECT_EQ(v.correspondences, 2u);
  EXPECT_EQ(v.precision, 1.0);
  EXPECT_EQ(v.recall, 1.0);
}

/// Queries whose best and second distances are best : 100, and whose best is right, or wrong with the right
/// one far off.
struct Query {
  float best;
  bool is_right;
};

Verified ofQueries(const std::vector<Query>& queries) {
  std::vector<Point> a;
  std::vector<Point> b;
  for (const Query& query : queries) {
    const float x = 10.0F * static_cast<float>(a.size());
    const float apart = 10000.0F * static_cast<float>(a.size());
    a.push_back({x, 0, apart + query.best});
    const float right = query.is_right ? 0.0F : 50.0F;
    b.push_back({x, right, apart});
    b.push_back({x, 50.0F - right, apart + query.best + 100.0F});
  }
  return verified(featuresOf(a), featuresOf(b), identityMaps({4000, 100}));
}

TEST(AveragePrecision, AddsPrecisionAtEachStepOfRecall) {
  // 0.1 wrong: precision 0. 0.2: 1 of 3, recall 1/4. 0.4: 2 of 4, recall 2/4.
  const double expected = 1.0 / 3.0 / 4.0 + 2.0 / 4.0 / 4.0;
  // Two roundings each, of a sum below 1.
  EXPECT_NEAR(ofQueries({{10, false}, {20, true}, {20, false}, {40, true}}).average_precision, expected,
              1e-15);
}

TEST(AveragePrecision, DoesNotHangOnTheOrderOfTies) {
  const double one = ofQueries({{10, false}, {20, true}, {20, false}, {40, true}}).average_precision;
  EXPECT_EQ(ofQueries({{40, true}, {20, false}, {20, true}, {10, false}}).average_precision, one);
  EXPECT_EQ(ofQueries({{20, true}, {20, false}, {20, true}, {20, false}}).average_precision,
            0.25);  // 2/4 · 2/4
}

TEST(AveragePrecision, IsOneWhereAllAreRightAndZeroWhereNone) {
  EXPECT_EQ(ofQueries({{10, true}, {20, true}, {90, true}}).average_precision, 1.0);
  EXPECT_EQ(ofQueries({{10, false}, {20, false}}).average_precision, 0.0);
}

TEST(AveragePrecision, PutsTwinsLast) {
  // The second query has two equal neighbours, of which the first is right; the first and third are wrong and
  // right. 0.1: 0 of 1; 0.5: 1 of 2, recall 1/3; 1: 2 of 3, recall 2/3.
  const Features a = featuresOf({{10, 0, 10}, {20, 0, 10000}, {30, 0, 20050}});
  const Features b = featuresOf(
      {{10, 50, 0}, {10, 0, 110}, {20, 0, 10000}, {90, 90, 10000}, {30, 0, 20000}, {80, 80, 20150}});
  EXPECT_NEAR(verified(a, b).average_precision, 1.0 / 2.0 / 3.0 + 2.0 / 3.0 / 3.0, 1e-15);
}

TEST(AveragePrecision, IsTheAreaOfOpenCvsCurve) {
  cv::RNG generator(3);
  std::vector<Query> queries;
  for (int i = 0; i < 300; ++i) {
    const float best = static_cast<float>(1 + i * 7 % 300) / 4.0F;  // all different
    queries.push_back({best, generator.uniform(0.0F, 60.0F) > best});
  }
  std::vector<std::vector<cv::DMatch>> matches;
  std::vector<std::vector<uchar>> is_right;
  for (const Query& query : queries) {
    matches.push_back({cv::DMatch(0, 0, query.best)});
    is_right.push_back({static_cast<uchar>(query.is_right)});
  }
  std::vector<cv::Point2f> curve;  // (1 − precision, recall)
  cv::computeRecallPrecisionCurve(matches, is_right, curve);
  double area = 0.0;
  double right = 0.0;
  for (std::size_t i = 0; i < curve.size(); ++i)
    area += (curve[i].y - (i == 0 ? 0.0F : curve[i - 1].y)) * (1.0 - curve[i].x);
  for (const Query& query : queries) right += query.is_right;
  ASSERT_GT(right, 50.0);
  ASSERT_LT(right, 250.0);
  // Its recall is of those that were found right, in single precision.
  EXPECT_NEAR(ofQueries(queries).average_precision, area * right / 300.0, 1e-5);
}

TEST(Verified, HasTheDifferenceOfTheSameMatches) {
  const Features a = featuresOf(kThreeOfA);
  const Features b = featuresOf(kThreeOfB);
  const DifferenceValue expected = featureDifference(a, b, cv::NORM_L2, {});
  const DifferenceValue found = verified(a, b).difference;
  EXPECT_EQ(found.value, expected.value);
  EXPECT_EQ(found.symmetric, expected.symmetric);
  EXPECT_EQ(found.one_to_one, expected.one_to_one);
  EXPECT_EQ(found.features_a, 3u);
  EXPECT_EQ(found.features_b, 3u);
}

TEST(Verified, IsZeroOrUndefinedWithoutFeatures) {
  const Features none;
  const Features three = featuresOf(kThreeOfA);
  for (const Verified& v : {verified(three, none), verified(none, three)}) {
    EXPECT_EQ(v.repeatability, 0.0);
    EXPECT_EQ(v.matching_score, 0.0);
    EXPECT_EQ(v.matching_accuracy[9], 0.0);
    EXPECT_TRUE(std::isnan(v.precision));
    EXPECT_TRUE(std::isnan(v.recall));
    EXPECT_TRUE(std::isnan(v.average_precision));
    EXPECT_EQ(v.difference.value, 1.0);
  }
  const Verified empty = verified(none, none);
  EXPECT_TRUE(std::isnan(empty.repeatability));
  EXPECT_TRUE(std::isnan(empty.matching_score));
  EXPECT_EQ(empty.matching_accuracy[0], 0.0);
  EXPECT_TRUE(std::isnan(empty.difference.value));
  // Features, but no common part.
  const Verified apart = verified(three, three, shifted(95.0));
  EXPECT_EQ(apart.common_a + apart.common_b, 0u);
  EXPECT_TRUE(std::isnan(apart.repeatability));
  EXPECT_EQ(apart.matching_score, 0.0);
  EXPECT_EQ(apart.matching_accuracy[9], 0.0);
  EXPECT_EQ(apart.precision, 0.0);  // each matches itself, and wrongly
  EXPECT_TRUE(std::isnan(apart.recall));
}

TEST(Verified, RefusesKeyPointsWithoutDescriptors) {
  Features odd = featuresOf(kThreeOfA);
  odd.key_points.pop_back();
  EXPECT_EQ(messageOf([&] { verified(odd, odd); }),
            "2 key points have 3 descriptors, but must have one each");
}

TEST(VerifiedFile, HasTheColumnsThatUsersRelyOn) {
  const TemporaryFolder folder;
  VerifiedRow row;
  row.a = "a,1.png";
  row.b = "b.png";
  row.detector = "orb";
  row.verified = verified(featuresOf(kThreeOfA), featuresOf(kThreeOfB));
  row.verified.recall = std::nan("");
  writeVerified(folder.file("verified.csv"), {row});
  EXPECT_EQ(contentOf(folder.file("verified.csv")),
            "a,b,detector,features_a,features_b,repeatability,matching_score_3px,mma_1px,mma_2px,mma_3px,"
            "mma_4px,mma_5px,mma_6px,mma_7px,mma_8px,mma_9px,mma_10px,mutual_matches,ratio_matches,"
            "precision_3px,recall_3px,average_precision_3px,d,d_symmetric,d_one_to_one\n"
            "\"a,1.png\",b.png,orb,3,3,0.66666666666666663,0.66666666666666663,0.33333333333333331,"
            "0.66666666666666663,0.66666666666666663,0.66666666666666663,0.66666666666666663,"
            "0.66666666666666663,0.66666666666666663,0.66666666666666663,0.66666666666666663,"
            "0.66666666666666663,3,3,0.66666666666666663,nan,1,0,0,0\n");
}

}  // namespace
}  // namespace sunlit::evaluate
