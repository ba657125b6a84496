#include "tools/camera_arguments.h"

#include <stdexcept>

namespace sunlit::tools {

render::RenderOptions CameraWords::options() const {
  render::RenderOptions options = render;
  if (!calibration.empty()) {
    const image::Calibration read = image::readCalibration(calibration);
    for (const image::TypedBeside& beside : typed) image::requireAgreement(read, calibration, beside);
    options.camera = read.camera;
    options.distortion = read.distortion;
    return options;
  }
  options.camera = image::PinholeCamera::fromFieldOfView(render.camera.width, render.camera.height,
                                                         Angle::degrees(fov_deg));
  return options;
}

void CameraWords::requireSense(const studio::BakeOptions& bake) const {
  if (render.final_gather > 0 && !bake.enabled)
    throw std::invalid_argument("--final-gather looks closer where light is baked; leave out --bounced off");
}

void addCamera(studio::CommandLine* line, CameraWords* words) {
  line->group("Camera");
  const std::vector<Field> rows = fieldsOf(words->render);
  line->add("--size WxH", "", {fieldOf(rows, "width"), fieldOf(rows, "height")})
      .then([words](const std::string& option, const std::string&) {
        words->typed.push_back({"width", option + " (width)", 1.0 * words->render.camera.width});
        words->typed.push_back({"height", option + " (height)", 1.0 * words->render.camera.height});
      });
  line->add("--fov DEG", image::fieldOfViewRow(&words->fov_deg))
      .then([words](const std::string& option, const std::string&) {
        words->typed.push_back({"horizontal_fov", option, words->fov_deg});
      });
  line->add("--calibration FILE", image::calibrationRow(&words->calibration));
  line->add("--supersampling N", fieldOf(rows, "supersampling"));
  line->add("--final-gather N",
            studio::explainedAs(fieldOf(rows, "final_gather"),
                                fieldOf(rows, "final_gather").doc + "; 2 takes seconds a picture"));
  line->add("--rasterizer", fieldOf(rows, "rasterizer"));
}

void requireNoDistortion(const render::RenderOptions& options, const std::string& purpose) {
  if (options.distortion.none()) return;
  throw std::invalid_argument("--calibration is of a lens with distortion (" +
                              image::nameOf(options.distortion.model) + "), but " + purpose +
                              " cameras without; leave it out, or give a file whose coefficients are zeros");
}

Eigen::Isometry3d mapFromCamera(const Eigen::Vector3d& eye, double yaw_rad, double pitch_rad) {
  Eigen::Isometry3d map_from_camera = Eigen::Isometry3d::Identity();
  map_from_camera.linear() = (Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) *
                              Eigen::AngleAxisd(-pitch_rad, Eigen::Vector3d::UnitY()))
                                 .toRotationMatrix();
  map_from_camera.translation() = eye;
  return map_from_camera;
}

Eigen::Isometry3d mapFromCamera(const TypedPose& pose) {
  return mapFromCamera({pose.x, pose.y, pose.z}, pose.yaw_deg * kRadPerDeg, pose.pitch_deg * kRadPerDeg);
}

}  // namespace sunlit::tools
