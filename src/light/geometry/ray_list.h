/// Rays on their way to the ray library.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sunlit/light/visibility.h"

namespace sunlit::light {

/// Rays, each of one thing that its owner numbers, such as a surface of a tile. Kept by threads, so that it
/// allocates nothing after a while.
class RayList {
 public:
  std::size_t size() const { return size_; }
  void clear() { size_ = 0; }
  /// To be called before so many are added.
  void reserve(std::size_t more) {
    if (size_ + more > number_.size()) grow(size_ + more);
  }
  void add(std::uint32_t number, const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) {
    number_[size_] = number;
    for (std::size_t k = 0; k < 3; ++k) {
      values_[k][size_] = origin[static_cast<Eigen::Index>(k)];
      values_[k + 3][size_] = direction[static_cast<Eigen::Index>(k)];
    }
    ++size_;
  }
  const std::uint32_t* number() const { return number_.data(); }
  Rays rays() const {
    return {values_[0].data(),
            values_[1].data(),
            values_[2].data(),
            values_[3].data(),
            values_[4].data(),
            values_[5].data(),
            size_};
  }
  /// Becomes the rays of `other`, those together that start in one column towards the disc: as seen from
  /// there, foliage lies about in depth, and neighbours in the picture meet other leaves. `across` and `up`
  /// are unit vectors at right angles to the way to the disc.
  void setInColumns(const RayList& other, const Eigen::Vector3f& across, const Eigen::Vector3f& up);

 private:
  void grow(std::size_t least);

  std::array<std::vector<float>, 6> values_;  ///< origins x, y, z, directions x, y, z
  std::vector<std::uint32_t> number_;
  std::size_t size_ = 0;
};

}  // namespace sunlit::light
