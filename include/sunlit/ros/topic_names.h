/// Names of topics that nodes and bags share: below a condition (`h04/camera/image_raw`), below the namespace
/// (`camera/pose`), below a node (`~progress`), or global.
#pragma once

namespace sunlit::ros_interface::topics {

// Of a condition: what stands in its sky, and what a camera sees under it.
constexpr const char* kSun = "sun";
constexpr const char* kMoon = "moon";
constexpr const char* kCelestial = "celestial";
constexpr const char* kSunMarker = "sun_marker";
constexpr const char* kMoonMarker = "moon_marker";
constexpr const char* kImage = "camera/image_raw";
constexpr const char* kCompressedImage = "camera/image_raw/compressed";
constexpr const char* kCameraInfo = "camera/camera_info";
constexpr const char* kCapture = "camera/capture";
// Of a stereo camera, whose left picture is kImage too.
constexpr const char* kLeftImage = "camera/left/image_raw";
constexpr const char* kRightImage = "camera/right/image_raw";

// Of a pose, whatever the condition.
constexpr const char* kDepth = "camera/depth/image_raw";
constexpr const char* kPose = "camera/pose";
constexpr const char* kPath = "path";

// Of a node.
constexpr const char* kProgress = "progress";
constexpr const char* kActivity = "activity";
constexpr const char* kPairDifference = "pair_difference";
constexpr const char* kSummary = "summary";
constexpr const char* kMatchesImage = "matches_image";
constexpr const char* kLocalisation = "localisation";
constexpr const char* kLocalisationSummary = "localisation/summary";
constexpr const char* kLocalisationMarkers = "localisation/markers";

// Of the whole system.
constexpr const char* kTf = "/tf";
constexpr const char* kTfStatic = "/tf_static";
constexpr const char* kClock = "/clock";

}  // namespace sunlit::ros_interface::topics
