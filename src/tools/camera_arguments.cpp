#include "tools/camera_arguments.h"

#include <stdexcept>

namespace sunlit::tools {

render::RenderOptions CameraWords::options() const {
  render::RenderOptions options = render;
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
  line->add("--size WxH", "", {fieldOf(rows, "width"), fieldOf(rows, "height")});
  line->add("--fov DEG", image::fieldOfViewRow(&words->fov_deg));
  line->add("--supersampling N", fieldOf(rows, "supersampling"));
  line->add("--final-gather N",
            studio::explainedAs(fieldOf(rows, "final_gather"),
                                fieldOf(rows, "final_gather").doc + "; 2 takes seconds a picture"));
  line->add("--rasterizer", fieldOf(rows, "rasterizer"));
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
