// Trajectory files, good and broken.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "sunlit/evaluate/trajectory/trajectory.h"
#include "support/message_of.h"
#include "support/temporary_folder.h"
#include "support/utf16.h"

namespace sunlit::evaluate {
namespace {

class TrajectoryFile : public ::testing::Test {
 protected:
  Trajectory read(const std::string& content) const {
    setContent(path_, content);
    return readTrajectory(path_);
  }
  std::int64_t stampOf(const std::string& stamp) const {
    return read(stamp + " 0 0 0 0 0 0 1\n").at(0).stamp_ns;
  }
  /// The error without the path, which it must start with.
  std::string errorOf(const std::string& content) const {
    const std::string text = messageOf<std::runtime_error>([&] { read(content); });
    EXPECT_EQ(text.compare(0, path_.size(), path_), 0) << text;
    return text.substr(std::min(text.size(), path_.size()));
  }

  const TemporaryFolder folder_;
  const std::string path_ = folder_.file("trajectory.txt");
};

void expectPose(const StampedPose& pose, std::int64_t stamp_ns, const Eigen::Vector3d& position,
                const Eigen::Quaterniond& orientation) {
  EXPECT_EQ(pose.stamp_ns, stamp_ns);
  EXPECT_EQ(pose.position, position);
  EXPECT_EQ(pose.orientation.coeffs(), orientation.coeffs());
}

TEST_F(TrajectoryFile, TumHasSecondsAndTheScalarLast) {
  const Trajectory poses =
      read("# timestamp tx ty tz qx qy qz qw\n1.5 1 2 3 0 0 1 0\n\n2\t-4e1  .5 6 1 0 0 0 # turned over\r\n");
  ASSERT_EQ(poses.size(), 2u);
  expectPose(poses[0], 1500000000, {1, 2, 3}, {0, 0, 0, 1});
  expectPose(poses[1], 2000000000, {-40, 0.5, 6}, {0, 1, 0, 0});
}

TEST_F(TrajectoryFile, TumMayHaveCommas) {
  const Trajectory poses = read(
      "\xEF\xBB\xBF"
      "1.5,1,2,3,0,0,0,1\n2, 4, 5, 6, 0, 0, 1, 0\n");
  ASSERT_EQ(poses.size(), 2u);
  expectPose(poses[0], 1500000000, {1, 2, 3}, {1, 0, 0, 0});
  expectPose(poses[1], 2000000000, {4, 5, 6}, {0, 0, 0, 1});
}

TEST_F(TrajectoryFile, EurocHasNanosecondsAndTheScalarFirst) {
  const Trajectory by_header = read(
      "#timestamp [ns], p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], q_RS_z "
      "[]\n"
      "1403715524907143168,1,2,3,0,1,0,0\n");
  ASSERT_EQ(by_header.size(), 1u);
  expectPose(by_header[0], 1403715524907143168, {1, 2, 3}, {0, 1, 0, 0});
  const Trajectory by_columns = read("7,1,2,3,0,0,1,0,9,9,9,9,9,9,9,9,9\n");
  ASSERT_EQ(by_columns.size(), 1u);
  expectPose(by_columns[0], 7, {1, 2, 3}, {0, 0, 1, 0});
}

// As ORB-SLAM3 writes what it made of EuRoC's pictures.
TEST_F(TrajectoryFile, TumHasNanosecondsWhereSecondsCannotBeSoMany) {
  const Trajectory poses = read(
      "1403715524907143168.000000 1 2 3 0 0 0 1\n"
      "1403715524957143040.000000 4 5 6 0 0 1 0\n");
  ASSERT_EQ(poses.size(), 2u);
  expectPose(poses[0], 1403715524907143168, {1, 2, 3}, {1, 0, 0, 0});
  expectPose(poses[1], 1403715524957143040, {4, 5, 6}, {0, 0, 0, 1});
  EXPECT_EQ(stampOf("1000100000000.000000"), 1000100000000);
  EXPECT_EQ(stampOf("-1000100000000"), -1000100000000);
  EXPECT_EQ(stampOf("9.3e9"), 9300000000);
  // By the first, for the whole file.
  EXPECT_EQ(read("1000100000000 0 0 0 0 0 0 1\n1.0002e12 0 0 0 0 0 0 1\n").size(), 2u);
  EXPECT_EQ(errorOf("1000100000000 0 0 0 0 0 0 1\n1 0 0\n"),
            ":2: has 3 columns, but must have 8: timestamp tx ty tz qx qy qz qw (ns, m)");
  EXPECT_EQ(errorOf("1 0 0 0 0 0 0 1\n1000100000000 0 0 0 0 0 0 1\n"),
            ":2: timestamp is \"1000100000000\", but must be a number of seconds within ±9.2e9 s");
}

TEST_F(TrajectoryFile, MillisecondsAndMicrosecondsAreNotTakenForNanoseconds) {
  for (const std::string zeros : {"", "000"}) {
    const std::string first = "1719820800000" + zeros, next = "1719820800100" + zeros;
    EXPECT_EQ(errorOf(first + " 0 0 0 0 0 0 1\n" + next + " 0 0 0 0 0 0 1\n"),
              ": timestamps beyond 9.2e9 are taken as nanoseconds, of which these would tell " +
                  std::string(zeros.empty() ? "10000000" : "10000") +
                  " poses a second, but it must be 5000 at most: write milliseconds and microseconds as "
                  "seconds");
  }
}

TEST_F(TrajectoryFile, StampsKeepEveryNanosecond) {
  EXPECT_EQ(stampOf("1403715529.112143517"), 1403715529112143517);
  EXPECT_EQ(stampOf("1.403715529112143517e+09"), 1403715529112143517);
  EXPECT_EQ(stampOf("1403715529112143517E-9"), 1403715529112143517);
  EXPECT_EQ(stampOf("-0.000000001"), -1);
  EXPECT_EQ(stampOf("+.5"), 500000000);
  EXPECT_EQ(stampOf("3."), 3000000000);
  EXPECT_EQ(stampOf("9.2e9"), 9200000000000000000);
}

TEST_F(TrajectoryFile, FinerDigitsOfStampsAreRounded) {
  EXPECT_EQ(stampOf("0.0000000014"), 1);
  EXPECT_EQ(stampOf("0.0000000015"), 2);
  EXPECT_EQ(stampOf("-0.0000000015"), -2);
  EXPECT_EQ(stampOf("1.9999999999"), 2000000000);
  EXPECT_EQ(stampOf("5e-10"), 1);
  EXPECT_EQ(stampOf("9e-11"), 0);
  EXPECT_EQ(stampOf("9e-300"), 0);
}

TEST_F(TrajectoryFile, QuaternionsOfFewDigitsAreMadeUnit) {
  const Trajectory poses = read("0 0 0 0 0.6132 0.5962 -0.3311 -0.3986\n");  // freiburg1_xyz: length 1.00003
  EXPECT_DOUBLE_EQ(poses[0].orientation.norm(), 1.0);
  EXPECT_NO_THROW(read("0 0 0 0 0 0 0 1.00099\n"));
  EXPECT_EQ(errorOf("0 0 0 0 0 0 0 1.0011\n"),
            ":1: the length of the quaternion is 1.0011, but must be 1 within 0.001");
  EXPECT_EQ(errorOf("0 0 0 0 0 0 0 0\n"),
            ":1: the length of the quaternion is 0, but must be 1 within 0.001");
}

TEST_F(TrajectoryFile, NamesTheLineOfAnotherForm) {
  const std::string tum = "timestamp tx ty tz qx qy qz qw (s, m)";
  EXPECT_EQ(errorOf("# a\n0 0 0 0 0 0 0 1\n\n1 0 0 0 0 0 1\n"), ":4: has 7 columns, but must have 8: " + tum);
  EXPECT_EQ(errorOf("hello\n"), ":1: has 1 column, but must have 8: " + tum);
  EXPECT_EQ(errorOf("1,0,0,0,0,0,0,1,\n"), ":1: has 9 columns, but must have 8: " + tum);
  EXPECT_EQ(errorOf("#timestamp,q_RS_w\n1,2,3\n"),
            ":2: has 3 columns, but must have 8: timestamp x y z qw qx qy qz … (ns, m)");
}

TEST_F(TrajectoryFile, ALineOfNothingThatIsSeenIsAnErrorToo) {
  EXPECT_EQ(errorOf("\v"), ":1: has 0 columns, but must have 8: timestamp tx ty tz qx qy qz qw (s, m)");
}

TEST_F(TrajectoryFile, NamesWhatIsNoNumber) {
  EXPECT_EQ(errorOf("0 0 0 0 0 0 0 1\n1 0 nan 0 0 0 0 1\n"),
            ":2: ty is \"nan\", but must be from -1000000000 to 1000000000");
  EXPECT_EQ(errorOf("0 0 0 0 0 0 0 inf\n"), ":1: qw is \"inf\", but must be a finite number");
  EXPECT_EQ(errorOf("0 0 0 1.0.0 0 0 0 1\n"),
            ":1: tz is \"1.0.0\", but must be from -1000000000 to 1000000000");
  EXPECT_EQ(errorOf("0 1.1e9 0 0 0 0 0 1\n"),
            ":1: tx is \"1.1e9\", but must be from -1000000000 to 1000000000");
  EXPECT_EQ(errorOf("0,,0,0,0,0,0,1\n"), ":1: tx is \"\", but must be from -1000000000 to 1000000000");
  for (const std::string stamp :
       {"nan", "1.0s", "1e", "e5", ".", "-", "1e+-2", "0x10", "1e999", "1403715524907143168000000000"})
    EXPECT_EQ(errorOf(stamp + " 0 0 0 0 0 0 1\n"),
              ":1: timestamp is \"" + stamp + "\", but must be a number of seconds within ±9.2e9 s");
}

TEST_F(TrajectoryFile, InUtf16IsRefusedByName) {
  EXPECT_EQ(errorOf(utf16Of("0 0 0 0 0 0 0 1\r\n1 0 0 0 0 0 0 1\r\n")), refusalOfUtf16(""));
  EXPECT_EQ(errorOf(utf16Of("# timestamp tx ty tz qx qy qz qw\n0 0 0 0 0 0 0 1\n")), refusalOfUtf16(""));
}

TEST_F(TrajectoryFile, StampsIncrease) {
  const std::string start = "1.000000001 0 0 0 0 0 0 1\n";
  EXPECT_EQ(read(start + "1.000000002 0 0 0 0 0 0 1\n").size(), 2u);
  EXPECT_EQ(errorOf(start + start),
            ":2: timestamp is 1.000000001, but must be above that of the pose before: stamps increase");
  EXPECT_NE(errorOf(start + "1 0 0 0 0 0 0 1\n"), "");
}

TEST_F(TrajectoryFile, TheFirstOfAStampCountsWhereThatIsAskedFor) {
  setContent(path_,
             "1 1 0 0 0 0 0 1\n2 2 0 0 0 0 0 1\n2.0 3 0 0 0 0 0 1\n2 4 0 0 0 0 0 1\n3 5 0 0 0 0 0 1\n");
  std::vector<std::int64_t> repeated;
  const Trajectory poses = readTrajectory(path_, &repeated);
  EXPECT_EQ(repeated, (std::vector<std::int64_t>{2000000000, 2000000000}));
  ASSERT_EQ(poses.size(), 3u);
  EXPECT_EQ(poses[1].position.x(), 2.0);
  setContent(path_, "2 2 0 0 0 0 0 1\n1 3 0 0 0 0 0 1\n");
  EXPECT_NE(messageOf<std::runtime_error>([&] { readTrajectory(path_, &repeated); }), "");
}

TEST_F(TrajectoryFile, WithoutPosesIsAnError) {
  EXPECT_EQ(errorOf(""), ": holds no pose, but must have lines of timestamp tx ty tz qx qy qz qw (s, m)");
  EXPECT_NE(errorOf("# only a comment\n"), "");
  EXPECT_EQ(messageOf<std::runtime_error>([&] { readTrajectory(folder_.file("none.txt")); }),
            folder_.file("none.txt") + ": cannot be opened: No such file or directory");
  EXPECT_NE(messageOf<std::runtime_error>([&] { readTrajectory(folder_.path()); }), "");
}

TEST_F(TrajectoryFile, LengthIsTheSumOfSteps) {
  EXPECT_DOUBLE_EQ(lengthOf(read("0 0 0 0 0 0 0 1\n1 3 4 0 0 0 0 1\n2 3 4 -2 0 0 0 1\n")), 7.0);
  EXPECT_EQ(lengthOf(read("0 5 5 5 0 0 0 1\n")), 0.0);
}

TEST(Trajectory, IsStraightBetweenTwoPosesAndTurnsTheShorterWay) {
  const auto turned = [](double degrees) {
    return Eigen::Quaterniond(Eigen::AngleAxisd(degrees * M_PI / 180.0, Eigen::Vector3d::UnitZ()));
  };
  StampedPose before{1000, {1, 2, 3}, turned(170)};
  const StampedPose after{2000, {3, 2, -1}, turned(-170)};
  before.orientation.coeffs() *= -1.0;  // the same turn
  const StampedPose found = interpolated(before, after, 1250);
  EXPECT_EQ(found.stamp_ns, 1250);
  EXPECT_LT((found.position - Eigen::Vector3d(1.5, 2, 2)).norm(), 1e-15);
  EXPECT_LT(found.orientation.angularDistance(turned(175)), 1e-12);  // a quarter of 20°
}

}  // namespace
}  // namespace sunlit::evaluate
