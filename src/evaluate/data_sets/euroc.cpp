#include "evaluate/data_sets/layout.h"
#include "sunlit/quantity/frames.h"

namespace sunlit::evaluate {
namespace {

constexpr const char* kTruth = "mav0/state_groundtruth_estimate0/";

std::string eurocStamp(const DataSetFrame& frame) {
  return std::to_string(frame.stamp_ns);
}

/// Of body_from_sensor.
std::string transformText(const Eigen::Matrix4d& transform) {
  std::string rows;
  for (int row = 0; row < 4; ++row) {
    rows += row == 0 ? "  data: [" : ",\n         ";
    rows += fixedTexts({transform(row, 0), transform(row, 1), transform(row, 2), transform(row, 3)}, ", ");
  }
  return "T_BS:\n  cols: 4\n  rows: 4\n" + rows + "]\n";
}

/// `right_m`: to the right of cam0.
std::string sensorText(const std::string& type, const DataSetOptions& options, double right_m = 0.0) {
  const image::PinholeCamera& camera = options.camera;
  return "sensor_type: " + type + "\ncomment: simulated, without distortion\n\n" +
         transformText((linkFromOptical() * Eigen::Translation3d(right_m, 0.0, 0.0)).matrix()) +
         "\nrate_hz: " + fixedText(options.rate_hz) + "\nresolution: [" + std::to_string(camera.width) +
         ", " + std::to_string(camera.height) + "]\ncamera_model: pinhole\nintrinsics: [" +
         fixedTexts({camera.fx, camera.fy, camera.cx, camera.cy}, ", ") +
         "] #fu, fv, cu, cv\ndistortion_model: radial-tangential\n"
         "distortion_coefficients: [0.0, 0.0, 0.0, 0.0]\n";
}

/// By the poses before and after it; at the ends by the one neighbour; of a single pose none.
Eigen::Vector3d velocityOf(const std::vector<DataSetFrame>& frames, std::size_t i) {
  const DataSetFrame& before = frames[i == 0 ? 0 : i - 1];
  const DataSetFrame& after = frames[i + 1 == frames.size() ? i : i + 1];
  if (after.stamp_ns == before.stamp_ns) return Eigen::Vector3d::Zero();
  return (after.map_from_camera.translation() - before.map_from_camera.translation()) /
         (static_cast<double>(after.stamp_ns - before.stamp_ns) * 1e-9);
}

TextFile truthOf(const std::vector<DataSetFrame>& frames) {
  std::string text =
      "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], q_RS_z [], "
      "v_RS_R_x [m s^-1], v_RS_R_y [m s^-1], v_RS_R_z [m s^-1], b_w_RS_S_x [rad s^-1], b_w_RS_S_y [rad "
      "s^-1], "
      "b_w_RS_S_z [rad s^-1], b_a_RS_S_x [m s^-2], b_a_RS_S_y [m s^-2], b_a_RS_S_z [m s^-2]\n";
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const Eigen::Vector3d p = frames[i].map_from_camera.translation();
    const Eigen::Quaterniond q = turnOf(frames[i].map_from_camera);
    const Eigen::Vector3d v = velocityOf(frames, i);
    text += eurocStamp(frames[i]) + ',' + fixedTexts({p.x(), p.y(), p.z()}, ",") + ',' +
            fixedTexts({q.w(), q.x(), q.y(), q.z()}, ",", kQuaternionDigits) + ',' +
            fixedTexts({v.x(), v.y(), v.z(), 0, 0, 0, 0, 0, 0}, ",") + '\n';
  }
  return {std::string(kTruth) + "data.csv", text};
}

std::vector<TextFile> eurocTexts(const DataSetOptions& options, const std::vector<DataSetFrame>& frames) {
  std::string list = "#timestamp [ns],filename\n", stamps;
  for (const DataSetFrame& frame : frames) {
    list += eurocStamp(frame) + ',' + eurocStamp(frame) + ".png\n";
    stamps += eurocStamp(frame) + '\n';
  }
  const std::string depth = "\n# of the 16-bit pictures, 0 where there is none\ndepth_steps_per_metre: ";
  std::vector<TextFile> files{
      {"mav0/body.yaml", "comment: the body is the camera's link, x forward, y left, z up\n"},
      {"mav0/cam0/data.csv", list},
      {"mav0/cam0/sensor.yaml", sensorText("camera", options)},
      {"mav0/depth0/data.csv", list},
      {"mav0/depth0/sensor.yaml",
       sensorText("depth", options) + depth + fixedText(options.depth_scale) + '\n'},
      {std::string(kTruth) + "sensor.yaml",
       "sensor_type: visual-inertial\ncomment: poses are exact; velocities are by differences; there is no "
       "inertial sensor, so its biases are 0\n\n" +
           transformText(Eigen::Matrix4d::Identity())},
      truthOf(frames),
      {"timestamps.txt", stamps},
      orbSlamSettings(options)};
  if (options.baseline_m > 0.0) {
    files.push_back({"mav0/cam1/data.csv", list});
    files.push_back({"mav0/cam1/sensor.yaml", sensorText("camera", options, options.baseline_m)});
  }
  return files;
}

}  // namespace

const DataSetLayout& eurocLayout() {
  static const DataSetLayout layout{
      "mav0/cam0/data/", "mav0/depth0/data/", "mav0/cam1/data/", eurocStamp, true, false, eurocTexts};
  return layout;
}

}  // namespace sunlit::evaluate
