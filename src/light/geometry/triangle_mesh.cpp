#include "light/geometry/triangle_mesh.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace sunlit::light {

TriangleMesh newTriangleMesh(RTCDevice device, std::size_t vertices, std::size_t triangles) {
  TriangleMesh mesh;
  mesh.handle = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  mesh.vertices = static_cast<Eigen::Vector3f*>(rtcSetNewGeometryBuffer(
      mesh.handle, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Eigen::Vector3f), vertices));
  mesh.triangles = static_cast<std::array<std::uint32_t, 3>*>(rtcSetNewGeometryBuffer(
      mesh.handle, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), triangles));
  if (!mesh.vertices || !mesh.triangles) {
    rtcReleaseGeometry(mesh.handle);
    throw std::runtime_error("ray library (Embree): out of memory, error code " +
                             std::to_string(static_cast<int>(rtcGetDeviceError(device))));
  }
  return mesh;
}

TriangleMesh newTriangleMesh(RTCDevice device, const Geometry& geometry,
                             const std::vector<std::uint32_t>& chosen) {
  const TriangleMesh mesh = newTriangleMesh(device, geometry.positions.size(), chosen.size());
  std::copy(geometry.positions.begin(), geometry.positions.end(), mesh.vertices);
  for (std::size_t i = 0; i < chosen.size(); ++i) mesh.triangles[i] = geometry.triangles[chosen[i]];
  return mesh;
}

void attach(const TriangleMesh& mesh, RTCScene scene, unsigned number) {
  rtcCommitGeometry(mesh.handle);
  rtcAttachGeometryByID(scene, mesh.handle, number);
  rtcReleaseGeometry(mesh.handle);
}

}  // namespace sunlit::light
