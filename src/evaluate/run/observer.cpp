#include "evaluate/run/observer.h"

#include <algorithm>
#include <utility>

#include "sunlit/evaluate/posed_view.h"

namespace sunlit::evaluate {
namespace {

/// What was told, or not.
struct Message {
  bool has_come;
  std::string fault;
  const char* topic;
};

std::string firstFaultOf(const std::vector<Message>& messages) {
  for (const Message& message : messages) {
    if (!message.has_come) return std::string("no ") + message.topic + " of this stamp";
    if (!message.fault.empty()) return std::string(message.topic) + ": " + message.fault;
  }
  return "";
}

std::string sizeOf(const cv::Size& size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height) + " px";
}

}  // namespace

Observer::Observer(const Setup& setup) : setup_(setup), truth_(setup.streams.size()), file_(setup.file) {
  const auto isAmong = [](const std::string& stream, const std::vector<std::string>& streams) {
    return std::count(streams.begin(), streams.end(), stream) > 0;
  };
  for (const std::string& stream : setup_.streams) {
    const bool is_query = isAmong(stream, setup_.roles.queries);
    roles_.push_back(isAmong(stream, setup_.roles.map) ? Role::kMap : is_query ? Role::kQuery : Role::kNone);
  }
}

bool Observer::isReady(std::int64_t stamp_ns, const std::vector<char>& needed) {
  if (std::count(needed.begin(), needed.end(), 1) == 0) return true;
  if (!truth_.has(stamp_ns)) return false;
  for (std::size_t s = 0; s < needed.size(); ++s) {
    if (needed[s] && roles_[s] != Role::kNone && !truth_.cameras(s).isReady(stamp_ns)) return false;
  }
  return true;
}

std::string Observer::faultOf(std::size_t stream, const GroundTruth::View& truth,
                              const cv::Size& size) const {
  if (roles_.at(stream) == Role::kNone) return "";
  const std::string fault =
      firstFaultOf({{truth.map_from_optical.has_come, truth.map_from_optical.fault, "camera/pose"},
                    {truth.cameras.at(stream).has_come, truth.cameras[stream].fault, "camera/camera_info"}});
  if (!fault.empty()) return fault;
  const ViewCamera& camera = truth.cameras[stream].value;
  const cv::Size of_camera(camera.width, camera.height);
  if (size != of_camera) return "is " + sizeOf(size) + ", but its camera_info " + sizeOf(of_camera);
  if (roles_[stream] != Role::kMap) return "";
  const std::string of_depth =
      firstFaultOf({{truth.depth.has_come, truth.depth.fault, "camera/depth/image_raw"}});
  if (!of_depth.empty() || truth.depth.value.size() == size) return of_depth;
  return "is " + sizeOf(size) + ", but its depth " + sizeOf(truth.depth.value.size());
}

bool Observer::observes(std::size_t stream, const std::string& detector) const {
  return roles_.at(stream) != Role::kNone &&
         std::count(setup_.detectors.begin(), setup_.detectors.end(), detector) > 0;
}

void Observer::observe(const ObservedPicture& picture, const GroundTruth::View& truth,
                       const std::string& detector, const Features& features) {
  PosedView view;
  view.camera = truth.cameras.at(picture.stream).value;
  view.map_from_optical = truth.map_from_optical.value;
  view.depth = truth.depth.value;
  // From here on the camera is a pinhole, and so are its key points.
  StraightFeatures ones = straightOnes(features, view.camera);
  Observation observation{view.camera, view.map_from_optical, std::move(ones.straight), {}};
  if (roles_[picture.stream] == Role::kMap) observation.points = pointsOf(view, ones.seen);
  file_.add({setup_.streams[picture.stream], detector, picture.pose, picture.stamp_ns}, observation);
}

}  // namespace sunlit::evaluate
