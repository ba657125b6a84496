// Waypoint files, good and broken.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "sunlit/path/path.h"
#include "support/message_of.h"
#include "support/temporary_folder.h"
#include "support/utf16.h"

namespace sunlit::path {
namespace {

namespace fs = std::filesystem;

/// A file that goes when the test ends.
class WaypointFile : public ::testing::Test {
 protected:
  Waypoints read(const std::string& content) {
    std::ofstream(path_) << content;
    return readWaypoints(path_.string());
  }
  /// The error without the path, which it must start with.
  std::string errorOf(const std::string& content) {
    const std::string text = messageOf<std::runtime_error>([&] { read(content); });
    const bool named = text.compare(0, path_.string().size(), path_.string()) == 0;
    EXPECT_TRUE(named) << text;
    return named ? text.substr(path_.string().size()) : text;
  }

  const TemporaryFolder folder_;
  const fs::path path_ = folder_.file("waypoints.txt");
};

TEST_F(WaypointFile, CsvWithCommentsHeaderAndBlankLines) {
  const Waypoints waypoints = read("# a centre line\nx,y,z\n1,2,3\n\n 4.5 , -5e1,6 # a bend\r\n");
  ASSERT_EQ(waypoints.size(), 2u);
  EXPECT_EQ(waypoints[0], Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(waypoints[1], Eigen::Vector3d(4.5, -50, 6));
}

TEST_F(WaypointFile, CsvWithoutHeight) {
  const Waypoints waypoints = read("1,2\n3,4\n");
  ASSERT_EQ(waypoints.size(), 2u);
  EXPECT_EQ(waypoints[1], Eigen::Vector3d(3, 4, 0));
}

TEST_F(WaypointFile, TumTrajectory) {
  const Waypoints waypoints =
      read("# timestamp tx ty tz qx qy qz qw\n0.0 1 2 3 0 0 0 1\n0.1\t4 5 6 0 0 0 1\n");
  ASSERT_EQ(waypoints.size(), 2u);
  EXPECT_EQ(waypoints[0], Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(waypoints[1], Eigen::Vector3d(4, 5, 6));
}

TEST_F(WaypointFile, NamesTheLineOfWhatIsNoNumber) {
  EXPECT_EQ(errorOf("x,y,z\n1,2,3\n4,nan,6\n"), ":3: 'nan' is not a finite number");
  EXPECT_EQ(errorOf("1,2,3\n4,inf,6\n"), ":2: 'inf' is not a finite number");
  EXPECT_EQ(errorOf("1,2,3\n4,five,6\n"), ":2: 'five' is not a finite number");
  EXPECT_EQ(errorOf("1,2,3\n4,5m,6\n"), ":2: '5m' is not a finite number");
  EXPECT_EQ(errorOf("1,2,3\n4,,6\n"), ":2: '' is not a finite number");
  EXPECT_EQ(errorOf("1,b,c\n1,2,3\n4,5,6\n"), ":1: 'b' is not a finite number");
  EXPECT_EQ(errorOf("0 1 2 3 0 0 0 1\n1 x 2 3 0 0 0 1\n"), ":2: 'x' is not a finite number");
}

TEST_F(WaypointFile, NamesAHeaderOfOtherColumns) {
  const auto said = [](const std::string& header) {
    return ":1: the header is " + header + ", but must be x,y,z or x,y, of columns in that order and in m";
  };
  EXPECT_EQ(errorOf("y,x,z\n1,2,3\n4,5,6\n"), said("y,x,z"));
  EXPECT_EQ(errorOf("lat,lon\n1,2\n4,5\n"), said("lat,lon"));
  EXPECT_EQ(errorOf("\"x\",\"y\",\"z\"\n1,2,3\n4,5,6\n"), said("\"x\",\"y\",\"z\""));
  EXPECT_EQ(errorOf("x [m], y [m]\r\n1,2\n4,5\n"), said("x [m], y [m]"));
  EXPECT_EQ(errorOf("1,2,3\ny,x,z\n"), ":2: 'y' is not a finite number");
}

TEST_F(WaypointFile, NamesTheLineOfWrongColumns) {
  const std::string expected =
      ": expected x,y,z or x,y with commas, or the eight columns of a TUM trajectory with blanks, found ";
  EXPECT_EQ(errorOf("1,2,3,4\n"), ":1" + expected + "4 columns separated by commas");
  EXPECT_EQ(errorOf("time,x,y,z,qx,qy,qz,qw\n0,1,2,3,0,0,0,1\n"),
            ":1" + expected + "8 columns separated by commas");
  EXPECT_EQ(errorOf("#\n1;2;3\n"), ":2" + expected + "1 column");
  EXPECT_EQ(errorOf("1 2 3\n"), ":1" + expected + "3 columns");
  EXPECT_EQ(errorOf("1,2,3\n4,5\n"), ":2: expected 3 columns as above, found 2");
}

TEST_F(WaypointFile, NeedsTwoDifferentPoints) {
  EXPECT_EQ(errorOf(""), ": a path needs two waypoints or more, there are 0");
  EXPECT_EQ(errorOf("x,y,z\n"), ":1: a path needs two waypoints or more, there are 0");
  EXPECT_EQ(errorOf("1,2,3\n"), ":1: a path needs two waypoints or more, there is 1");
  EXPECT_EQ(errorOf("1,2,3\n4,5,6\n4,5,6\n"),
            ":3: it is less than 1 mm from the waypoint before it in plan view; leave it out");
}

std::string tumOf(const std::vector<std::string>& places) {
  std::string text;
  for (std::size_t i = 0; i < places.size(); ++i) text += std::to_string(i) + " " + places[i] + " 0 0 0 1\n";
  return text;
}

// Recorded ones stand still at their ends; those that creep lose no way.
TEST_F(WaypointFile, TumTrajectoriesMayStandStill) {
  std::ofstream(path_) << tumOf({"0 0 1", "0 0 1", "0 0.0009 1.5", "0.0006 0.0009 1", "1 0 1", "1 0 1"});
  std::vector<std::string> told;
  const Waypoints waypoints =
      readWaypoints(path_.string(), [&](const std::string& line) { told.push_back(line); });
  ASSERT_EQ(waypoints.size(), 3u);
  EXPECT_EQ(waypoints[1], Eigen::Vector3d(0.0006, 0.0009, 1));
  EXPECT_EQ(waypoints[2], Eigen::Vector3d(1, 0, 1));
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0], path_.string() + ": 3 poses left out, less than 1 mm in plan view from the one before");
  EXPECT_EQ(posesAlong(waypoints, {}).size(), 2u);
  EXPECT_EQ(read(tumOf({"0 0 1", "0 0 1", "1 0 1"})).size(), 2u) << "nobody listens";
}

TEST_F(WaypointFile, OfTumNothingIsToldWhereNothingStands) {
  std::ofstream(path_) << tumOf({"0 0 1", "1 0 1"});
  readWaypoints(path_.string(), [](const std::string& line) { ADD_FAILURE() << line; });
  EXPECT_EQ(
      errorOf(tumOf({"0 0 1", "0 0 1"})),
      ":2: a path needs two waypoints or more, there is 1; 1 pose left out, less than 1 mm in plan view "
      "from the one before");
  EXPECT_EQ(errorOf(tumOf({"0 0 1", "0 0 1e9"})),
            ":2: z is 1000000000, but must be from -10000000 to 10000000 m");
}

TEST_F(WaypointFile, IsUtf8WithOrWithoutItsMark) {
  EXPECT_EQ(read("\xEF\xBB\xBF"
                 "0,0\n1,0\n")
                .size(),
            2u);
  EXPECT_EQ(errorOf(utf16Of("0,0\r\n1,0\r\n")), refusalOfUtf16(""));
}

TEST(WaypointFiles, AMissingOneIsNamed) {
  EXPECT_EQ(messageOf<std::runtime_error>([] { readWaypoints("/nowhere/track.csv"); }),
            "/nowhere/track.csv: cannot open this waypoint file");
}

TEST(WaypointFiles, AFolderIsNamed) {
  const TemporaryFolder folder;
  const std::string path = folder.file("dir.csv");
  fs::create_directory(path);
  EXPECT_EQ(messageOf<std::runtime_error>([&] { readWaypoints(path); }),
            path + ": this is a folder, and no waypoint file");
}

TEST(WaypointFiles, TheCentreLineOfForzaIsRead) {
  const std::string file = SUNLIT_SHARED_DIR "/worlds/forza/waypoints.csv";
  if (!fs::exists(file)) GTEST_SKIP() << file << " is not here";
  EXPECT_EQ(readWaypoints(file).size(), 486u);  // its lines less a comment and a header
}

}  // namespace
}  // namespace sunlit::path
