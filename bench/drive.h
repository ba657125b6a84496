/// A drive through a world, and the daylight over it, as several benchmarks measure them.
#pragma once

#include <Eigen/Geometry>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "sunlit/quantity/frames.h"
#include "sunlit/sky/atmosphere.h"
#include "sunlit/sky/weather.h"

namespace sunlit::bench {

/// A real circuit, from the shared input.
inline const std::string kCircuit = std::string(SUNLIT_SHARED_DIR) + "/worlds/forza/forza.glb";

/// A camera 1 m above `points[at]`, level, towards the next.
inline Eigen::Isometry3d poseAt(const std::vector<Eigen::Vector3d>& points, std::size_t at) {
  const Eigen::Vector3d towards = points[(at + 1) % points.size()] - points[at];
  Eigen::Isometry3d map_from_link = Eigen::Isometry3d::Identity();
  map_from_link.linear() =
      Eigen::AngleAxisd(std::atan2(towards.y(), towards.x()), Eigen::Vector3d::UnitZ()).toRotationMatrix();
  map_from_link.translation() = points[at] + Eigen::Vector3d::UnitZ();
  return map_from_link * linkFromOptical();
}

inline std::vector<Eigen::Vector3d> circuitPoints() {
  std::ifstream file(std::string(SUNLIT_SHARED_DIR) + "/worlds/forza/waypoints.csv");
  std::vector<Eigen::Vector3d> points;
  for (std::string line; std::getline(file, line);) {
    Eigen::Vector3d p;
    if (std::sscanf(line.c_str(), "%lf,%lf,%lf", &p.x(), &p.y(), &p.z()) == 3) points.push_back(p);
  }
  return points;
}

/// That `work` takes.
template <typename Work>
double secondsOf(const Work& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

inline sky::Daylight daylightAt(double elevation_deg, const sky::Weather& weather = {}) {
  static const sky::Atmosphere atmosphere{sky::AtmosphereOptions()};
  const Direction towards(Azimuth::degrees(120.0), Angle::degrees(elevation_deg));
  return atmosphere.daylight({towards, 1.0}, {}, weather);
}

}  // namespace sunlit::bench
