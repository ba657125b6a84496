#include <cstdio>

#include "evaluate/data_sets/layout.h"
#include "sunlit/quantity/frames.h"

namespace sunlit::evaluate {
namespace {

std::string nameOf(const DataSetFrame& frame) {
  char name[40];
  std::snprintf(name, sizeof name, "%06lld", static_cast<long long>(frame.number));
  return name;
}

/// "PINHOLE 640 480 fx fy cx cy", as COLMAP counts pixels.
std::string cameraText(const image::PinholeCamera& camera) {
  constexpr double kCentreFromCorner_px = 0.5;
  return "PINHOLE " + std::to_string(camera.width) + ' ' + std::to_string(camera.height) + ' ' +
         fixedTexts(
             {camera.fx, camera.fy, camera.cx + kCentreFromCorner_px, camera.cy + kCentreFromCorner_px}, " ");
}

std::string poseText(const DataSetFrame& frame) {
  const Eigen::Isometry3d optical_from_map = (frame.map_from_camera * linkFromOptical()).inverse();
  const Eigen::Vector3d t = optical_from_map.translation();
  const Eigen::Quaterniond q = turnOf(optical_from_map);
  return fixedTexts({q.w(), q.x(), q.y(), q.z()}, " ", kQuaternionDigits) + ' ' +
         fixedTexts({t.x(), t.y(), t.z()}, " ");
}

std::vector<TextFile> texts(const DataSetOptions& options, const std::vector<DataSetFrame>& frames) {
  const std::string camera = cameraText(options.camera);
  TextFile images{"sparse/0/images.txt",
                  "# Image list with two lines of data per image:\n"
                  "#   IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME\n"
                  "#   POINTS2D[] as (X, Y, POINT3D_ID)\n"
                  "# Number of images: " +
                      std::to_string(frames.size()) + '\n'};
  TextFile queries{"queries_with_intrinsics.txt", ""};
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const std::string name = nameOf(frames[i]) + ".png";
    images.text += std::to_string(i + 1) + ' ' + poseText(frames[i]) + " 1 " + name + "\n\n";
    queries.text += name + ' ' + camera + '\n';
  }
  return {{"sparse/0/cameras.txt",
           "# Camera list with one line of data per camera:\n"
           "#   CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n"
           "# Number of cameras: 1\n1 " +
               camera + '\n'},
          {"sparse/0/points3D.txt",
           "# 3D point list with one line of data per point:\n"
           "#   POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[] as (IMAGE_ID, POINT2D_IDX)\n"
           "# Number of points: 0\n"},
          images,
          queries};
}

}  // namespace

const DataSetLayout& colmapLayout() {
  static const DataSetLayout layout{"images/", "depth/", "", nameOf, false, true, texts};
  return layout;
}

}  // namespace sunlit::evaluate
