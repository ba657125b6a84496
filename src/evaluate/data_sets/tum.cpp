#include <cstdio>

#include "evaluate/data_sets/layout.h"
#include "sunlit/quantity/frames.h"

namespace sunlit::evaluate {
namespace {

/// "1000.100000000": seconds, to the nanosecond.
std::string tumStamp(const DataSetFrame& frame) {
  constexpr std::int64_t kNanosecondsPerSecond = 1000000000;
  char text[40];
  std::snprintf(text, sizeof text, "%lld.%09lld",
                static_cast<long long>(frame.stamp_ns / kNanosecondsPerSecond),
                static_cast<long long>(frame.stamp_ns % kNanosecondsPerSecond));
  return text;
}

std::string poseOf(const DataSetFrame& frame) {
  const Eigen::Isometry3d map_from_optical = frame.map_from_camera * linkFromOptical();
  const Eigen::Vector3d t = map_from_optical.translation();
  const Eigen::Quaterniond q = turnOf(map_from_optical);
  return fixedTexts({t.x(), t.y(), t.z()}, " ") + ' ' +
         fixedTexts({q.x(), q.y(), q.z(), q.w()}, " ", kQuaternionDigits);
}

std::vector<TextFile> tumTexts(const DataSetOptions& options, const std::vector<DataSetFrame>& frames) {
  // Three lines before the first number, as in TUM's own: there are readers that skip so many unread.
  const std::string by = "# file: made by sunlit\n";
  TextFile rgb{"rgb.txt", "# color images\n" + by + "# timestamp filename\n"};
  TextFile depth{"depth.txt", "# depth maps\n" + by + "# timestamp filename\n"};
  TextFile both{"associations.txt", ""};
  TextFile truth{"groundtruth.txt",
                 "# ground truth trajectory\n"
                 "# of the camera's optical frame (z forward, x right, y down), in map\n"
                 "# timestamp tx ty tz qx qy qz qw\n"};
  for (const DataSetFrame& frame : frames) {
    const std::string stamp = tumStamp(frame);
    const std::string of_rgb = stamp + " rgb/" + stamp + ".png";
    const std::string of_depth = stamp + " depth/" + stamp + ".png";
    rgb.text += of_rgb + '\n';
    depth.text += of_depth + '\n';
    both.text += of_rgb + ' ' + of_depth + '\n';
    truth.text += stamp + ' ' + poseOf(frame) + '\n';
  }
  return {rgb, depth, both, truth, orbSlamSettings(options)};
}

}  // namespace

const DataSetLayout& tumLayout() {
  static const DataSetLayout layout{"rgb/", "depth/", "", tumStamp, false, false, tumTexts};
  return layout;
}

}  // namespace sunlit::evaluate
