/// Samples that many small triangles share.
#pragma once

#include <unordered_map>
#include <vector>

#include "light/bake/samples/probe.h"
#include "light/bake/samples/transport_data.h"

namespace sunlit::light {

/// Points at least `spacing` apart among those of similar normal and the same face.
class SampleCloud {
 public:
  /// Normals are similar whose product is at least `cosine`. Points share a receiver that lie at most
  /// `depth_m` off its plane.
  SampleCloud(float spacing_m, float cosine, float depth_m)
      : spacing_m_(spacing_m), cosine_(cosine), depth_m_(depth_m) {}

  /// Adds a receiver where none is near enough; else lets one that is near gather from the new origin too.
  void cover(const Eigen::Vector3f& position, const Receiver& receiver);
  /// Up to four receivers about `position`, indices into receivers(), like `receiver`, which was covered; the
  /// near ones weigh most; weights sum to 1.
  std::vector<LightMesh::Share> around(const Eigen::Vector3f& position, const Receiver& receiver) const;

  const std::vector<Receiver>& receivers() const { return receivers_; }

 private:
  std::uint64_t key(int x, int y, int z) const;
  float depth(std::uint32_t receiver, const Eigen::Vector3f& position) const;
  template <typename Visit>
  void visitNear(const Eigen::Vector3f& position, const Visit& visit) const;

  float spacing_m_;
  float cosine_;
  float depth_m_;
  std::vector<Receiver> receivers_;
  std::vector<Eigen::Vector3f> positions_;
  std::vector<std::size_t> covered_;  ///< how often each receiver was found near enough
  std::vector<std::uint32_t> next_;
  std::unordered_map<std::uint64_t, std::uint32_t> first_;
};

}  // namespace sunlit::light
