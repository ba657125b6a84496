/// Triangles for the ray library.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "light/geometry/embree.h"
#include "sunlit/light/geometry.h"

namespace sunlit::light {

struct ReleaseDevice {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseScene {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
/// Released also where a constructor throws.
using DevicePointer = std::unique_ptr<std::remove_pointer_t<RTCDevice>, ReleaseDevice>;
using ScenePointer = std::unique_ptr<std::remove_pointer_t<RTCScene>, ReleaseScene>;

/// Throws OutOfMemory, or std::runtime_error, where there can be none.
DevicePointer newDevice();

/// What is being made of so many triangles, for requireFine().
std::string treeOf(std::size_t triangles);

/// A mesh of Embree, not yet committed; whoever makes it releases it.
struct TriangleMesh {
  RTCGeometry handle = nullptr;
  Eigen::Vector3f* vertices = nullptr;                ///< to be filled
  std::array<std::uint32_t, 3>* triangles = nullptr;  ///< to be filled: three indices into `vertices` each
};

/// Throws OutOfMemory.
TriangleMesh newTriangleMesh(RTCDevice device, std::size_t vertices, std::size_t triangles);
/// The triangles `chosen` of `geometry`, in their order, not yet committed; whoever makes it releases it.
/// Their vertices are those of `geometry`, which must outlive all that it is attached to. Throws as above.
RTCGeometry triangleMesh(RTCDevice device, const Geometry& geometry,
                         const std::vector<std::uint32_t>& chosen);
/// Commits a mesh, hands it over to `scene` under `number`, and releases it.
void attach(RTCGeometry mesh, RTCScene scene, unsigned number);

}  // namespace sunlit::light
