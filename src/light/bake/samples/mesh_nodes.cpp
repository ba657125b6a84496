#include "light/bake/samples/mesh_nodes.h"

#include <algorithm>
#include <cmath>

#include "sunlit/quantity/random.h"

namespace sunlit::light {
namespace {

constexpr float kLeastPulled = 1e-6f;
constexpr float kInwards_m = 0.02f;  ///< of a receiver on an open edge, away from the edge

std::uint64_t placeKey(const Eigen::Vector3f& position) {
  std::uint64_t key = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto step = static_cast<std::int64_t>(std::lround(static_cast<double>(position[axis]) * 1000.0));
    key = scrambled(key ^ static_cast<std::uint64_t>(step));
  }
  return key;
}

}  // namespace

void MeshNode::pullTowards(const Eigen::Vector3f& middle, float counts) {
  const Eigen::Vector3f way = middle - position;
  if (way.isZero(0.0f)) return;
  inwards += counts * way.normalized();
  pulled += counts;
}

void MeshNode::pullNoMore() {
  inwards.setZero();
  pulled = 0.0f;
  aside.setZero();
  room_m = 1e9f;
}

Receiver MeshNode::receiver() const {
  constexpr float kOfRoom = 0.5f;
  const Eigen::Vector3f pull = inwards * (kInwards_m / std::max(pulled, kLeastPulled));
  const float most_m = kOfRoom * room_m, length_m = pull.norm();
  const Eigen::Vector3f origin = position + aside + (length_m > most_m ? most_m / length_m : 1.0f) * pull;
  Receiver receiver;
  receiver.origins.fill(origin);
  receiver.lifts.fill(Receiver::clearance_m(origin) * flat());
  receiver.normal = normal;
  receiver.face = face;
  return receiver;
}

Eigen::Vector3f MeshNode::aboveBumps() const {
  constexpr float kAbove_m = 0.03f;
  return position + kAbove_m * normal;
}

std::uint32_t NodeIndex::at(const Eigen::Vector3f& position, const Eigen::Vector3f& normal,
                            const Eigen::Vector3f& face) {
  const Eigen::Vector3f bounding = boundingFace(normal, face);
  const auto added = static_cast<std::uint32_t>(nodes.size());
  const auto [entry, fresh] = first_.try_emplace(placeKey(position), added);
  std::uint32_t last = entry->second;
  if (!fresh) {
    for (std::uint32_t at = entry->second; at != LightMesh::kNone; at = next_[at]) {
      if (nodes[at].normal.dot(normal) > kSharedCosine && sameFace(nodes[at].face, bounding)) return at;
      last = at;
    }
    next_[last] = added;
  }
  MeshNode node;
  node.position = position;
  node.normal = normal;
  node.face = bounding;
  nodes.push_back(node);
  next_.push_back(LightMesh::kNone);
  return added;
}

Eigen::Vector3f middleOf(const LightMesh::Cell& leaf, const std::vector<MeshNode>& nodes) {
  Eigen::Vector3f middle = Eigen::Vector3f::Zero();
  for (const std::uint32_t n : leaf.corner) middle += nodes[n].position / 3.0f;
  return middle;
}

float longestEdge(const LightMesh::Cell& leaf, const std::vector<MeshNode>& nodes) {
  float longest_m = 0.0f;
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Vector3f& next = nodes[leaf.corner[(k + 1) % 3]].position;
    longest_m = std::max(longest_m, (nodes[leaf.corner[k]].position - next).norm());
  }
  return longest_m;
}

bool mayCarry(const LightMesh::Cell& leaf, const std::vector<MeshNode>& nodes) {
  const auto& [a, b, c] = leaf.corner;
  const float nearest_m = std::min({nodes[a].nearest_m, nodes[b].nearest_m, nodes[c].nearest_m});
  return nearest_m < 2.0f * longestEdge(leaf, nodes);
}

}  // namespace sunlit::light
