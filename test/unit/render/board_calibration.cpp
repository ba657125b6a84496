// OpenCV's calibration finds the lens by pictures of a chessboard that were taken with it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "sunlit/quantity/turn.h"
#include "support/published_lenses.h"
#include "test_scenes.h"

namespace sunlit::test {
namespace {

/// Squares of a board, corner (0, 0) of which lies at the origin of its frame, facing −z.
constexpr int kBoardAcross = 9, kBoardDown = 7;  // squares; corners are one fewer
constexpr double kSquare_m = 0.06;

scene::Scene boardScene() {
  scene::Scene scene;
  const int white = addMaterial(&scene, {0.9f, 0.9f, 0.9f}),
            black = addMaterial(&scene, {0.02f, 0.02f, 0.02f});
  const auto side = static_cast<float>(kSquare_m);
  for (int j = -1; j <= kBoardDown; ++j) {
    for (int i = -1; i <= kBoardAcross; ++i) {
      const bool rim = i < 0 || j < 0 || i == kBoardAcross || j == kBoardDown;
      const int material = !rim && (i + j) % 2 == 0 ? black : white;
      addPatch(&scene, material, {side * static_cast<float>(i - 1), side * static_cast<float>(j), 0.0f},
               {0.0f, -side, 0.0f}, {side, 0.0f, 0.0f});
    }
  }
  return scene;
}

/// Whether each is where the lens shows it, within 2 px: OpenCV 4.10 finds one in a thousand at an edge
/// beside.
bool areWhereShown(const std::vector<cv::Point2f>& pixels, const std::vector<cv::Point3f>& board,
                   const Eigen::Isometry3d& optical_from_board, const image::Lens& lens) {
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const Eigen::Vector3d at(board[i].x, board[i].y, board[i].z);
    const auto shown = lens.project(optical_from_board * at);
    if (!shown || std::hypot(shown->x() - pixels[i].x, shown->y() - pixels[i].y) > 2.0) return false;
  }
  return true;
}

/// Pictures of the board all over the camera's, and where its corners are in them.
struct BoardPictures {
  std::vector<std::vector<cv::Point3f>> points;
  std::vector<std::vector<cv::Point2f>> pixels;
};

BoardPictures boardPictures(const PublishedLens& published, int pictures) {
  render::RenderOptions options;
  options.camera = published.camera;
  options.distortion = published.distortion;
  options.supersampling = 4;
  render::Renderer renderer(shared(boardScene()), options);
  const image::Lens lens = published.lens();
  BoardPictures board_pictures;
  std::vector<cv::Point3f> board;
  for (int j = 0; j + 1 < kBoardDown; ++j)
    for (int i = 0; i + 1 < kBoardAcross; ++i)
      board.emplace_back(static_cast<float>(i * kSquare_m), static_cast<float>(j * kSquare_m), 0.0f);
  const Eigen::Vector3d middle(0.5 * (kBoardAcross - 2) * kSquare_m, 0.5 * (kBoardDown - 2) * kSquare_m, 0.0);
  for (int n = 0; n < pictures; ++n) {
    // Where its middle is to be seen: round the picture, at several distances and slants.
    const double turn = 2.4 * n, out = 0.3 * std::sqrt((n % 6) / 5.0);
    const Eigen::Vector2d at(published.camera.width * (0.5 + out * std::cos(turn)),
                             published.camera.height * (0.5 + out * std::sin(turn)));
    const Eigen::Vector3d towards = lens.unproject(at).value().normalized() * (0.5 + 0.08 * (n % 4));
    const Eigen::Matrix3d turned = (turnBetween(Eigen::Vector3d::UnitZ(), towards) *
                                    Eigen::AngleAxisd(0.5 * std::sin(1.7 * n), Eigen::Vector3d::UnitX()) *
                                    Eigen::AngleAxisd(0.5 * std::cos(1.1 * n), Eigen::Vector3d::UnitY()))
                                       .toRotationMatrix();
    Eigen::Isometry3d optical_from_board = Eigen::Isometry3d::Identity();
    optical_from_board.linear() = turned;
    optical_from_board.translation() = towards - turned * middle;
    renderer.look(optical_from_board.inverse());
    cv::Mat grey(published.camera.height, published.camera.width, CV_8UC1, cv::Scalar(128));
    for (const light::Tile& tile : renderer.surfaces().tiles) {
      std::map<std::uint32_t, double> sums;
      for (const light::Surface& surface : tile.surfaces)
        sums[surface.pixel] += (surface.material == 0 ? 220.0 : 20.0) * surface.samples / 16.0;
      for (const auto& [pixel, sum] : sums)
        grey.at<std::uint8_t>(static_cast<int>(pixel) / grey.cols, static_cast<int>(pixel) % grey.cols) =
            cv::saturate_cast<std::uint8_t>(sum);
    }
    std::vector<cv::Point2f> pixels;
    if (!cv::findChessboardCorners(grey, {kBoardAcross - 1, kBoardDown - 1}, pixels)) continue;
    cv::cornerSubPix(grey, pixels, {4, 4}, {-1, -1},
                     {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 100, 1e-4});
    if (!areWhereShown(pixels, board, optical_from_board, lens)) continue;
    board_pictures.points.push_back(board);
    board_pictures.pixels.push_back(pixels);
  }
  return board_pictures;
}

// Corners are found to a tenth of a pixel, some 1,000 of them: 0.1 % of f is what that leaves with ease. What
// it leaves of the rest the calibration says itself, as standard deviations of all that it estimates: four.
TEST(LensPicture, CalibratingABoardFindsTheLensOfEuroc) {
  const PublishedLens published = eurocLens();
  const BoardPictures board_pictures = boardPictures(published, 24);
  ASSERT_GE(board_pictures.points.size(), 15u);
  cv::Mat k, d, deviations;
  std::vector<cv::Mat> r, t;
  const double rms = cv::calibrateCamera(board_pictures.points, board_pictures.pixels,
                                         {published.camera.width, published.camera.height}, k, d, r, t,
                                         deviations, cv::noArray(), cv::noArray(), cv::CALIB_FIX_K3);
  EXPECT_LT(rms, 0.1);
  EXPECT_NEAR(k.at<double>(0, 0) / published.camera.fx, 1.0, 1e-3);
  EXPECT_NEAR(k.at<double>(1, 1) / published.camera.fy, 1.0, 1e-3);
  const auto within = [&](int i) { return 4.0 * deviations.at<double>(i); };
  EXPECT_LT(within(2), 1.0);
  EXPECT_NEAR(k.at<double>(0, 2), published.camera.cx, within(2));
  EXPECT_NEAR(k.at<double>(1, 2), published.camera.cy, within(3));
  const std::vector<double>& coefficients = published.distortion.coefficients;
  for (int i = 0; i < 4; ++i) {
    EXPECT_LT(within(4 + i), 0.002);
    EXPECT_NEAR(d.at<double>(i), coefficients[static_cast<std::size_t>(i)], within(4 + i)) << i;
  }
}

/// Distance from the middle of an equidistant lens, px.
double equidistantRadius(double focal_px, double theta, const std::vector<double>& k) {
  const double square = theta * theta;
  return focal_px * theta * (1.0 + square * (k[0] + square * (k[1] + square * (k[2] + square * k[3]))));
}

TEST(LensPicture, CalibratingABoardFindsTheLensOfTumVi) {
  const PublishedLens published = tumViLens();
  const BoardPictures board_pictures = boardPictures(published, 24);
  ASSERT_GE(board_pictures.points.size(), 15u);
  cv::Mat k, d;
  std::vector<cv::Mat> r, t;
  const double rms = cv::fisheye::calibrate(
      board_pictures.points, board_pictures.pixels, {published.camera.width, published.camera.height}, k, d,
      r, t, cv::fisheye::CALIB_RECOMPUTE_EXTRINSIC | cv::fisheye::CALIB_FIX_SKEW);
  EXPECT_LT(rms, 0.1);
  EXPECT_NEAR(k.at<double>(0, 0) / published.camera.fx, 1.0, 1e-3);
  EXPECT_NEAR(k.at<double>(1, 1) / published.camera.fy, 1.0, 1e-3);
  EXPECT_NEAR(k.at<double>(0, 2), published.camera.cx, 0.2);
  EXPECT_NEAR(k.at<double>(1, 2), published.camera.cy, 0.2);
  // Four powers of one angle stand in for each other, and with f: what they make together is known as well as
  // corners are, as far out as there are some.
  double widest = 0.0;
  for (const std::vector<cv::Point2f>& pixels : board_pictures.pixels) {
    for (const cv::Point2f& pixel : pixels) {
      const Eigen::Vector3d ray = published.lens().unproject(Eigen::Vector2d(pixel.x, pixel.y)).value();
      widest = std::max(widest, std::acos(ray.normalized().z()));
    }
  }
  EXPECT_GT(widest, 1.0);
  const std::vector<double> found(d.begin<double>(), d.end<double>());
  for (double theta = 0.05; theta < widest; theta += 0.05) {
    EXPECT_NEAR(equidistantRadius(k.at<double>(0, 0), theta, found),
                equidistantRadius(published.camera.fx, theta, published.distortion.coefficients), 0.1)
        << theta;
  }
}

}  // namespace
}  // namespace sunlit::test
