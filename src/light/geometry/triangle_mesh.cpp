#include "light/geometry/triangle_mesh.h"

#include <stdexcept>
#include <string>

#include "light/geometry/embree_fault.h"

namespace sunlit::light {

namespace {

using Indices = std::array<std::uint32_t, 3>;

[[noreturn]] void giveUp(RTCGeometry handle, std::size_t triangles) {
  rtcReleaseGeometry(handle);
  failWith(RTC_ERROR_OUT_OF_MEMORY, treeOf(triangles));
}

Indices* newTriangles(RTCGeometry handle, std::size_t count) {
  return static_cast<Indices*>(
      rtcSetNewGeometryBuffer(handle, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(Indices), count));
}

}  // namespace

std::string treeOf(std::size_t triangles) {
  return "a tree of " + std::to_string(triangles) + " triangles for rays";
}

DevicePointer newDevice() {
  DevicePointer device(rtcNewDevice(nullptr));
  if (device) return device;
  requireFine(nullptr, "starting the ray library");
  throw std::runtime_error("ray library (Embree): no device");
}

TriangleMesh newTriangleMesh(RTCDevice device, std::size_t vertices, std::size_t triangles) {
  TriangleMesh mesh;
  mesh.handle = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  mesh.vertices = static_cast<Eigen::Vector3f*>(rtcSetNewGeometryBuffer(
      mesh.handle, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Eigen::Vector3f), vertices));
  mesh.triangles = newTriangles(mesh.handle, triangles);
  if (!mesh.vertices || !mesh.triangles) giveUp(mesh.handle, triangles);
  return mesh;
}

RTCGeometry triangleMesh(RTCDevice device, const Geometry& geometry,
                         const std::vector<std::uint32_t>& chosen) {
  const RTCGeometry handle = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetSharedGeometryBuffer(handle, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, geometry.positions.data(),
                             0, sizeof(Eigen::Vector3f), geometry.positions.size());
  Indices* const triangles = newTriangles(handle, chosen.size());
  if (!triangles) giveUp(handle, chosen.size());
  for (std::size_t i = 0; i < chosen.size(); ++i) triangles[i] = geometry.triangles[chosen[i]];
  return handle;
}

void attach(RTCGeometry mesh, RTCScene scene, unsigned number) {
  rtcCommitGeometry(mesh);
  rtcAttachGeometryByID(scene, mesh, number);
  rtcReleaseGeometry(mesh);
}

}  // namespace sunlit::light
