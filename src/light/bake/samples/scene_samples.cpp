#include "light/bake/samples/scene_samples.h"

#include <algorithm>
#include <cmath>

#include "light/bake/samples/sample_cloud.h"
#include "light/bake/samples/sample_order.h"
#include "light/bake/samples/sample_paint.h"
#include "light/bake/samples/thin_sheets.h"
#include "sunlit/quantity/random.h"

namespace sunlit::light {
namespace {

using Shares = std::vector<LightMesh::Share>;

/// How samples are spread over small triangles.
struct CloudRule {
  TriangleKind kind;
  float spacing_m;
  float cosine;   ///< of normals that may share a sample
  float depth_m;  ///< how far off its plane such may lie
  float merge_m;  ///< vertices in a cube of this size share a node
};
constexpr CloudRule kSmallRule{TriangleKind::kSmall, 0.12f, 0.9f, 0.04f, 0.03f};
constexpr CloudRule kFoliageRule{TriangleKind::kFoliage, 1.0f, 0.5f, 2.0f, 0.4f};
constexpr std::size_t kMostOfVertex = 6;

/// Equal samples put together, the smallest shares dropped, sum 1.
void tidy(Shares* shares) {
  std::sort(shares->begin(), shares->end(),
            [](const LightMesh::Share& a, const LightMesh::Share& b) { return a.sample < b.sample; });
  Shares merged;
  for (const LightMesh::Share& share : *shares) {
    if (!merged.empty() && merged.back().sample == share.sample) {
      merged.back().weight += share.weight;
    } else {
      merged.push_back(share);
    }
  }
  std::stable_sort(merged.begin(), merged.end(),
                   [](const LightMesh::Share& a, const LightMesh::Share& b) { return a.weight > b.weight; });
  if (merged.size() > kMostOfVertex) merged.resize(kMostOfVertex);
  float sum = 0.0f;
  for (const LightMesh::Share& share : merged) sum += share.weight;
  for (LightMesh::Share& share : merged) share.weight /= sum;
  *shares = std::move(merged);
}

class Sampler {
 public:
  Sampler(const BakeScene& scene, const AreaLights& bright)
      : geometry_(scene.geometry), traits_(scene.traits), builder_(scene, bright) {}

  SceneSamples sample(const RefineLimits& limits, const Progress& progress) {
    CloudRule small_rule = kSmallRule, foliage_rule = kFoliageRule;
    const SampleCloud small = cloudWithin(limits.nodes, &small_rule);
    std::size_t taken = small.receivers().size();
    const SampleCloud foliage = cloudWithin(withoutTaken(limits, taken).nodes, &foliage_rule);
    taken += foliage.receivers().size() + countCardSides();
    builder_.refine(withoutTaken(limits, taken), progress);
    sampleTrees();
    under_way_.assign(shares_.size(), false);
    for (std::uint32_t n = 0; n < shares_.size(); ++n) hang(n);
    fillInvalid();
    // From those that have been filled.
    for (std::uint32_t n = 0; n < shares_.size(); ++n)
      if (!hang(n)) addSample(n);
    addCloud(small_rule, small);
    addCloud(foliage_rule, foliage);
    addCards();
    SceneSamples samples = finish();
    orderSamples(&samples);
    paintSamples(geometry_, &samples);
    return samples;
  }

 private:
  /// Two triangles at most, whose sides share two samples and nodes.
  struct Card {
    std::uint32_t first;  ///< triangle
    std::uint32_t node, first_sample;
    float transmission;
    int triangles = 1;
    std::uint32_t sample(std::size_t side) const { return first_sample + static_cast<std::uint32_t>(side); }
  };

  /// What is left to others, a quarter at least.
  static RefineLimits withoutTaken(RefineLimits limits, std::size_t taken) {
    constexpr std::size_t kLeastPart = 4;
    limits.nodes = std::max(limits.nodes / kLeastPart, limits.nodes - std::min(limits.nodes, taken));
    return limits;
  }

  void sampleTrees() {
    const std::vector<MeshNode>& nodes = builder_.index.nodes;
    shares_.resize(nodes.size());
    for (std::uint32_t n = 0; n < nodes.size(); ++n) {
      if (nodes[n].valid && builder_.hangs_between[n][0] == LightMesh::kNone) addSample(n);
    }
  }

  /// Nodes inside bodies take the light of their neighbours, ring by ring: it is interpolated towards them.
  void fillInvalid() {
    constexpr int kRings = 4;
    for (int ring = 0; ring < kRings; ++ring) {
      std::vector<std::pair<std::uint32_t, Shares>> found;
      std::vector<std::uint32_t> slot(shares_.size(), LightMesh::kNone);
      for (const LightMesh::Cell& cell : builder_.mesh.cells) {
        if (cell.inner()) continue;
        for (std::size_t k = 0; k < 3; ++k) {
          const std::uint32_t n = cell.corner[k];
          if (!shares_[n].empty() || builder_.hangs_between[n][0] != LightMesh::kNone) continue;
          if (slot[n] == LightMesh::kNone) {
            slot[n] = static_cast<std::uint32_t>(found.size());
            found.push_back({n, {}});
          }
          for (std::uint32_t from : {cell.corner[(k + 1) % 3], cell.corner[(k + 2) % 3]}) {
            const Shares& other = shares_[from];
            Shares& to = found[slot[n]].second;
            to.insert(to.end(), other.begin(), other.end());
          }
        }
      }
      for (auto& [n, shares] : found) {
        if (shares.empty()) continue;
        tidy(&shares);
        shares_[n] = std::move(shares);
      }
    }
    for (std::uint32_t n = 0; n < shares_.size(); ++n) {
      if (shares_[n].empty() && builder_.hangs_between[n][0] == LightMesh::kNone) addSample(n);
    }
  }

  /// A node amid an undivided edge has the mean light of the edge's ends, so that light is continuous there.
  /// False: one of them has none yet, or hangs from this one, as where sheets overlap.
  bool hang(std::uint32_t n) {
    if (!shares_[n].empty()) return true;
    if (under_way_[n] || builder_.hangs_between[n][0] == LightMesh::kNone) return false;
    under_way_[n] = true;
    const auto [a, b] = builder_.hangs_between[n];
    const bool both = hang(a) && hang(b);
    under_way_[n] = false;
    if (!both) return false;
    Shares mean = shares_[a];
    mean.insert(mean.end(), shares_[b].begin(), shares_[b].end());
    tidy(&mean);
    shares_[n] = std::move(mean);
    return true;
  }

  void addSample(std::uint32_t node) {
    shares_[node] = {{static_cast<std::uint32_t>(receivers_.size()), 1.0f}};
    receivers_.push_back(builder_.index.nodes[node].receiver());
  }

  struct Corner {
    Eigen::Vector3f position, normal;
    Receiver receiver;
  };
  Corner cornerOf(std::uint32_t t, int side, std::size_t k) const {
    const Eigen::Vector3f flat = sideNormal(geometry_, t, side);
    Eigen::Vector3f centre = Eigen::Vector3f::Zero();
    for (std::uint32_t v : geometry_.triangles[t]) centre += geometry_.positions[v] / 3.0f;
    const std::uint32_t v = geometry_.triangles[t][k];
    Eigen::Vector3f normal = geometry_.normals[v];
    if (normal.dot(flat) < 0.0f) normal = -normal;
    if (normal.squaredNorm() < 0.5f) normal = flat;
    const Eigen::Vector3f& position = geometry_.positions[v];
    Receiver receiver;
    receiver.origins.fill(isLeaf(traits_[t].kind) ? centre
                                                  : Eigen::Vector3f(position + 0.4f * (centre - position)));
    receiver.lifts.fill(Receiver::clearance_m(receiver.origins[0]) * flat);
    receiver.normal = normal;
    receiver.coarse = isLeaf(traits_[t].kind);
    // Of other sheets, each side has its own light: see coupleSheets().
    receiver.transmission = receiver.coarse ? transmissionOf(t) : 0.0f;
    receiver.thin = receiver.transmission > 0.0f;
    if (!receiver.thin && !receiver.coarse) receiver.face = boundingFace(normal, flat);
    return {position, normal, receiver};
  }

  /// Equal for corners that share a node; others have the same by a chance of 2⁻⁶⁴.
  static std::uint64_t keyOf(const Corner& corner, float merge_m) {
    std::uint64_t key = 0;
    const auto add = [&key](float value) {
      key = scrambled(key ^ static_cast<std::uint64_t>(std::lround(value)));
    };
    for (int axis = 0; axis < 3; ++axis) {
      add(corner.position[axis] / merge_m);
      add(1.5f * corner.normal[axis]);
      add(1.5f * corner.receiver.face[axis]);
    }
    return key;
  }

  float transmissionOf(std::uint32_t t) const {
    return geometry_.scene->materials[static_cast<std::size_t>(geometry_.materials[t])].transmission;
  }

  /// Visits each corner of each lit side of the triangles of `kind`.
  template <typename Visit>
  void visitCorners(TriangleKind kind, const Visit& visit) const {
    for (std::uint32_t t = 0; t < traits_.size(); ++t) {
      if (traits_[t].kind != kind) continue;
      for (int side = 0; side < 2; ++side) {
        if (!traits_[t].used[side]) continue;
        for (std::size_t k = 0; k < 3; ++k) visit(t, side, k, cornerOf(t, side, k));
      }
    }
  }

  SampleCloud cloudOf(const CloudRule& rule) const {
    SampleCloud cloud(rule.spacing_m, rule.cosine, rule.depth_m);
    visitCorners(rule.kind, [&](std::uint32_t, int, std::size_t, const Corner& corner) {
      cloud.cover(corner.position, corner.receiver);
    });
    return cloud;
  }

  /// Of `most` samples, about, as far as normals allow: coarser than the rule says where the scene is too
  /// finely cut for it.
  SampleCloud cloudWithin(std::size_t most, CloudRule* rule) const {
    constexpr int kMostTries = 4;
    SampleCloud cloud = cloudOf(*rule);
    for (int i = 0; i < kMostTries && cloud.receivers().size() > most; ++i) {
      const auto over = static_cast<float>(cloud.receivers().size()) / static_cast<float>(most);
      const float coarser = 1.1f * std::sqrt(over);  // samples lie on surfaces
      rule->spacing_m *= coarser;
      rule->depth_m *= coarser;
      rule->merge_m *= coarser;
      cloud = cloudOf(*rule);
    }
    return cloud;
  }

  void addCloud(const CloudRule& rule, const SampleCloud& cloud) {
    const auto base = static_cast<std::uint32_t>(receivers_.size());
    receivers_.insert(receivers_.end(), cloud.receivers().begin(), cloud.receivers().end());
    std::unordered_map<std::uint64_t, std::uint32_t> node_of;
    std::array<std::uint32_t, 3> nodes;
    visitCorners(rule.kind, [&](std::uint32_t t, int side, std::size_t k, const Corner& corner) {
      const auto [entry, fresh] =
          node_of.try_emplace(keyOf(corner, rule.merge_m), static_cast<std::uint32_t>(shares_.size()));
      if (fresh) {
        Shares shares = cloud.around(corner.position, corner.receiver);
        for (LightMesh::Share& share : shares) share.sample += base;
        shares_.push_back(std::move(shares));
      }
      nodes[k] = entry->second;
      if (k < 2) return;
      builder_.mesh.roots[t][static_cast<std::size_t>(side)] =
          static_cast<std::uint32_t>(builder_.mesh.cells.size());
      builder_.mesh.cells.push_back({nodes});
    });
  }

  bool isCard(std::uint32_t t) const {
    return traits_[t].kind == TriangleKind::kSpray || traits_[t].kind == TriangleKind::kCanopy;
  }
  /// Two a card, of two triangles.
  std::size_t countCardSides() const {
    std::size_t count = 0;
    for (std::uint32_t t = 0; t < traits_.size(); ++t) count += isCard(t) ? 1 : 0;
    return count;
  }

  /// One sample on each side of a card; LeafOpenness knows what lies open of it.
  void addCards() {
    std::vector<std::uint32_t> card_at(geometry_.positions.size(), LightMesh::kNone);
    for (std::uint32_t t = 0; t < traits_.size(); ++t) {
      if (!isCard(t)) continue;
      std::uint32_t number = LightMesh::kNone;
      for (const std::uint32_t v : geometry_.triangles[t]) {
        if (card_at[v] != LightMesh::kNone && cards_[card_at[v]].triangles < 2) number = card_at[v];
      }
      if (number == LightMesh::kNone) {
        number = static_cast<std::uint32_t>(cards_.size());
        addCard(t);
      } else {
        addOtherHalf(t, &cards_[number]);
      }
      for (const std::uint32_t v : geometry_.triangles[t]) card_at[v] = number;
      const Card& card = cards_[number];
      const bool turned = isTurned(t, card);
      for (std::size_t side = 0; side < 2; ++side) {
        const std::uint32_t node = card.node + static_cast<std::uint32_t>(turned ? 1 - side : side);
        builder_.mesh.roots[t][side] = static_cast<std::uint32_t>(builder_.mesh.cells.size());
        builder_.mesh.cells.push_back({{node, node, node}});
      }
    }
    for (const Card& card : cards_) {
      receivers_[card.sample(1)] = receivers_[card.sample(0)];
      receivers_[card.sample(1)].normal *= -1.0f;
    }
  }

  void addCard(std::uint32_t t) {
    cards_.push_back({t, static_cast<std::uint32_t>(shares_.size()),
                      static_cast<std::uint32_t>(receivers_.size()), transmissionOf(t)});
    for (std::size_t side = 0; side < 2; ++side) {
      shares_.push_back({{cards_.back().sample(side), 1.0f}});
      receivers_.push_back(middleOf(t));
    }
  }

  /// Whether the front of a card's triangle is on the side of the first one's back.
  bool isTurned(std::uint32_t t, const Card& card) const {
    return geometry_.planes[t].normal.dot(geometry_.planes[card.first].normal) < 0.0f;
  }

  void addOtherHalf(std::uint32_t t, Card* card) {
    const Receiver receiver = middleOf(t);
    Receiver& first = receivers_[card->sample(0)];
    for (std::size_t i = 1; i < Receiver::kOrigins; i += 2) {
      first.origins[i] = receiver.origins[i];
      first.lifts[i] = receiver.lifts[i];
    }
    const Eigen::Vector3f sum = isTurned(t, *card) ? Eigen::Vector3f(first.normal - receiver.normal)
                                                   : Eigen::Vector3f(first.normal + receiver.normal);
    // Normals of the file may point anywhere: then that of the first half stands for both.
    if (sum.squaredNorm() > 1e-6f) first.normal = sum.normalized();
    ++card->triangles;
  }

  /// Looks from four points of a card's triangle.
  Receiver middleOf(std::uint32_t t) const {
    Receiver receiver = cornerOf(t, 0, 0).receiver;  // with the triangle's middle as its origin
    Eigen::Vector3f normal = receiver.normal;
    for (std::size_t k = 1; k < 3; ++k) normal += cornerOf(t, 0, k).receiver.normal;
    receiver.normal = normal.normalized();
    for (std::size_t i = 0; i < 3; ++i)
      receiver.origins[i] += 0.5f * (geometry_.positions[geometry_.triangles[t][i]] - receiver.origins[3]);
    receiver.transmission = 0.0f;  // what comes from behind is added as it is passed on
    return receiver;
  }

  SceneSamples finish() {
    SceneSamples samples;
    samples.mesh = std::move(builder_.mesh);
    samples.receivers = std::move(receivers_);
    samples.other_side.resize(samples.receivers.size());
    for (const Card& card : cards_) {
      for (std::size_t side = 0; side < 2; ++side)
        samples.other_side[card.sample(side)] = {card.sample(1 - side), card.transmission, true};
    }
    samples.mesh.first_share.push_back(0);
    std::vector<LightMesh::Share>& all = samples.mesh.shares.own();
    for (const Shares& shares : shares_) {
      all.insert(all.end(), shares.begin(), shares.end());
      samples.mesh.first_share.push_back(static_cast<std::uint32_t>(all.size()));
    }
    return samples;
  }

  const Geometry& geometry_;
  const std::vector<TriangleTraits>& traits_;
  MeshBuilder builder_;
  std::vector<Receiver> receivers_;
  std::vector<Shares> shares_;   ///< of each node
  std::vector<bool> under_way_;  ///< nodes whose ends are being looked at
  std::vector<Card> cards_;
};

}  // namespace

SceneSamples sampleScene(const BakeScene& scene, const AreaLights& bright, const RefineLimits& limits,
                         const Progress& progress) {
  SceneSamples samples = Sampler(scene, bright).sample(limits, progress);
  coupleSheets(scene, &samples);
  return samples;
}

}  // namespace sunlit::light
