// What the picture shows where.
#include "sunlit/evaluate/trajectory/draw_trajectory.h"

#include <gtest/gtest.h>

#include "sunlit/image/files.h"
#include "support/message_of.h"
#include "support/temporary_folder.h"

namespace sunlit::evaluate {
namespace {

/// Corners of a square of 100 m about the origin.
Trajectory square() {
  Trajectory trajectory(4);
  for (std::size_t i = 0; i < 4; ++i) {
    trajectory[i].stamp_ns = static_cast<std::int64_t>(i) * 1000000000;
    trajectory[i].position = {i == 0 || i == 3 ? -50.0 : 50.0, i < 2 ? -50.0 : 50.0, 0.0};
  }
  return trajectory;
}

image::Rgb8Image red(int size) {
  image::Rgb8Image picture(size, size);
  for (std::size_t i = 0; i < picture.data.size(); i += 3) picture.data[i] = 255;
  return picture;
}

TEST(DrawTrajectory, IsTheSameEveryTimeAndNotEmpty) {
  Trajectory estimate = square();
  estimate[2].position.x() += 5.0;
  const TrajectoryEvaluation evaluation = evaluateTrajectory(square(), estimate, {});
  const image::Rgb8Image first = drawTrajectory(square(), evaluation);
  EXPECT_EQ(first.width, 1200);
  EXPECT_EQ(first.height, 1000);
  EXPECT_EQ(first.data, drawTrajectory(square(), evaluation).data);
  EXPECT_NE(first.data, drawTrajectory(square(), evaluateTrajectory(square(), square(), {})).data);
}

TEST(DrawTrajectory, APoseAloneCanBeDrawn) {
  const Trajectory one{StampedPose()};
  EXPECT_NO_THROW(drawTrajectory(one, evaluateTrajectory(one, one, {})));
  Trajectory far = one;
  far[0].position = {1e18, -1e18, 0.0};  // where a double has no metres
  EXPECT_NO_THROW(drawTrajectory(far, evaluateTrajectory(far, far, {})));
}

TEST(DrawTrajectory, LaysTheMapWhereItsExtentSays) {
  const TrajectoryEvaluation evaluation = evaluateTrajectory(square(), square(), {});
  // The square fills the frame's 620 px by 100 m and a margin of 8 %, about its middle (570, 360): 5.74 px a
  // metre. The map covers the quarter to the upper right, up to 40 m; its pixels are finer than the sheet's.
  const MapPicture map{red(400), 0.0, 40.0, 0.0, 40.0};
  const image::Rgb8Image picture = drawTrajectory(square(), evaluation, &map);
  const auto isPaleRed = [&](int x, int y) {
    const std::uint8_t* pixel = picture.at(x, y);
    return pixel[0] == 255 && pixel[1] == 128 && pixel[2] == 128;
  };
  EXPECT_TRUE(isPaleRed(570 + 7, 360 - 7));
  EXPECT_TRUE(isPaleRed(570 + 222, 360 - 222));
  EXPECT_FALSE(isPaleRed(570 + 237, 360 - 100));
  EXPECT_FALSE(isPaleRed(570 + 100, 360 - 237));
  EXPECT_FALSE(isPaleRed(570 - 7, 360 - 7));
  EXPECT_FALSE(isPaleRed(570 + 7, 360 + 7));
}

TEST(MapPicture, IsReadWithItsExtent) {
  const TemporaryFolder folder;
  image::writePng(folder.file("map.png"), red(8));
  setContent(folder.file("map.yaml"), "x_min: -1.5\nx_max: 2\ny_min: 3\ny_max: 4e1\n");
  const MapPicture map = readMapPicture(folder.path());
  EXPECT_EQ(map.picture.width, 8);
  EXPECT_EQ(map.x_min, -1.5);
  EXPECT_EQ(map.x_max, 2.0);
  EXPECT_EQ(map.y_min, 3.0);
  EXPECT_EQ(map.y_max, 40.0);
}

TEST(MapPicture, WithoutAnExtentIsRefused) {
  const TemporaryFolder folder;
  const auto error = [&] { return messageOf<std::runtime_error>([&] { readMapPicture(folder.path()); }); };
  EXPECT_EQ(error(), folder.file("map.yaml") + ": cannot be opened: No such file or directory");
  image::writePng(folder.file("map.png"), red(8));
  setContent(folder.file("map.yaml"), "x_min: -1.5\nx_max: wide\n");
  EXPECT_EQ(error(), folder.file("map.yaml") + ": has no line \"x_max: METRES\"");
  setContent(folder.file("map.yaml"), "x_min: 2\nx_max: 1\ny_min: 3\ny_max: 4\n");
  EXPECT_EQ(error(), folder.file("map.yaml") + ": x_min must be below x_max, and y_min below y_max");
}

}  // namespace
}  // namespace sunlit::evaluate
