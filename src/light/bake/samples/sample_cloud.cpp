#include "light/bake/samples/sample_cloud.h"

#include <algorithm>
#include <cmath>

namespace sunlit::light {
namespace {
constexpr std::size_t kMostOfPlace = 4;
constexpr float kDeepest =
    1.5f;  ///< times the depth that receivers are shared over, one may still have a part
}  // namespace

std::uint64_t SampleCloud::key(int x, int y, int z) const {
  const auto part = [](int value) {
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(value)) & 0x1fffffu;
  };
  return part(x) << 42 | part(y) << 21 | part(z);
}

float SampleCloud::depth(std::uint32_t receiver, const Eigen::Vector3f& position) const {
  return std::abs(receivers_[receiver].normal.dot(position - positions_[receiver]));
}

/// All receivers within twice the spacing of `position`, and some beyond.
template <typename Visit>
void SampleCloud::visitNear(const Eigen::Vector3f& position, const Visit& visit) const {
  const float cell_m = 2.0f * spacing_m_;
  const Eigen::Vector3i cell = (position / cell_m).array().floor().cast<int>();
  for (int i = 0; i < 27; ++i) {
    const auto entry = first_.find(key(cell.x() + i % 3 - 1, cell.y() + i / 3 % 3 - 1, cell.z() + i / 9 - 1));
    if (entry == first_.end()) continue;
    for (std::uint32_t at = entry->second; at != LightMesh::kNone; at = next_[at]) {
      const float distance = (positions_[at] - position).norm();
      if (distance < cell_m) visit(at, distance);
    }
  }
}

void SampleCloud::cover(const Eigen::Vector3f& position, const Receiver& receiver) {
  std::uint32_t nearest = LightMesh::kNone;
  float nearest_m = spacing_m_;
  visitNear(position, [&](std::uint32_t at, float distance) {
    if (distance >= nearest_m || receivers_[at].normal.dot(receiver.normal) < cosine_) return;
    if (depth(at, position) > depth_m_ || !sameFace(receivers_[at].face, receiver.face)) return;
    nearest = at;
    nearest_m = distance;
  });
  if (nearest != LightMesh::kNone) {
    // Of many, those stay whose number is a power of two: spread over all, without a random number.
    const std::size_t times = ++covered_[nearest];
    if ((times & (times - 1)) != 0) return;
    std::size_t slot = 0;
    while (times >> (slot + 1) != 0) ++slot;
    slot = (slot + 1) % Receiver::kOrigins;
    receivers_[nearest].origins[slot] = receiver.origins[0];
    receivers_[nearest].lifts[slot] = receiver.lifts[0];
    return;
  }
  const Eigen::Vector3i cell = (position / (2.0f * spacing_m_)).array().floor().cast<int>();
  const auto added = static_cast<std::uint32_t>(receivers_.size());
  const auto [entry, fresh] = first_.try_emplace(key(cell.x(), cell.y(), cell.z()), added);
  next_.push_back(fresh ? LightMesh::kNone : entry->second);
  entry->second = added;
  receivers_.push_back(receiver);
  positions_.push_back(position);
  covered_.push_back(0);
}

std::vector<LightMesh::Share> SampleCloud::around(const Eigen::Vector3f& position,
                                                  const Receiver& receiver) const {
  std::vector<LightMesh::Share> shares;
  visitNear(position, [&](std::uint32_t at, float distance) {
    const float cosine = receivers_[at].normal.dot(receiver.normal);
    const float least = cosine_ - 0.2f;
    if (cosine < least || depth(at, position) > kDeepest * depth_m_) return;
    if (!sameFace(receivers_[at].face, receiver.face)) return;
    const float close = 1.0f - 0.5f * distance / spacing_m_;
    shares.push_back({at, close * close * close * close * (cosine - least + 0.05f)});
  });
  std::sort(shares.begin(), shares.end(), [](const LightMesh::Share& a, const LightMesh::Share& b) {
    return a.weight != b.weight ? a.weight > b.weight : a.sample < b.sample;
  });
  if (shares.size() > kMostOfPlace) shares.resize(kMostOfPlace);
  float sum = 0.0f;
  for (const LightMesh::Share& share : shares) sum += share.weight;
  for (LightMesh::Share& share : shares) share.weight /= sum;
  return shares;
}

}  // namespace sunlit::light
