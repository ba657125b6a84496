/// What nodes of final gathering were found to see, kept from pose to pose.
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "light/picture/outlook/outlook.h"

namespace sunlit::light {

/// Nodes by 64-bit keys. Those that no recent pose has asked for are forgotten.
class KeptNodes {
 public:
  using Key = std::uint64_t;

  /// A pose, or a part of one, needs all of `keys`, each once. Returns those that are new: their skies are to
  /// be filled in. Ends the validity of references.
  std::vector<Key> require(const std::vector<Key>& keys);

  /// Of a node that the present pose needs.
  GatheredSky& at(Key key) { return now_.skies[now_.number.at(key)]; }
  const GatheredSky& at(Key key) const { return now_.skies[now_.number.at(key)]; }

  std::size_t size() const { return now_.skies.size() + before_.skies.size(); }

 private:
  /// Nodes of several poses.
  struct Age {
    std::unordered_map<Key, std::uint32_t> number;
    std::vector<GatheredSky> skies;
    std::size_t largest = 0;  ///< nodes of the largest pose
  };
  Age now_, before_;
};

}  // namespace sunlit::light
