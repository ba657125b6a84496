#include "light/geometry/ray_list.h"

#include <algorithm>

namespace sunlit::light {
namespace {

constexpr std::uint32_t kSide = 32;  // columns, there and back in every second row

using Places = Eigen::ArrayXf;

/// The column of each ray.
void findColumns(const Places& x, const Places& y, std::vector<std::uint32_t>* columns) {
  const float low_x = x.minCoeff(), low_y = y.minCoeff();
  const float widest = std::max({x.maxCoeff() - low_x, y.maxCoeff() - low_y, 1e-3f});
  const float scale = (static_cast<float>(kSide) - 0.5f) / widest;
  for (std::size_t i = 0; i < columns->size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    const auto column = static_cast<std::uint32_t>(static_cast<std::int32_t>((x[at] - low_x) * scale));
    const auto row = static_cast<std::uint32_t>(static_cast<std::int32_t>((y[at] - low_y) * scale));
    (*columns)[i] = row * kSide + (row % 2 == 0 ? column : kSide - 1 - column);
  }
}

}  // namespace

void RayList::grow(std::size_t least) {
  for (auto& list : values_) list.resize(2 * least);
  number_.resize(2 * least);
}

void RayList::setInColumns(const RayList& other, const Eigen::Vector3f& across, const Eigen::Vector3f& up) {
  clear();
  if (other.size() == 0) return;
  reserve(other.size());
  size_ = other.size();
  const auto count = static_cast<Eigen::Index>(size_);
  thread_local Places places_x, places_y;
  thread_local std::vector<std::uint32_t> columns;
  const auto along = [&](const Eigen::Vector3f& axis) {
    const auto of = [&](std::size_t k) { return Eigen::Map<const Places>(other.values_[k].data(), count); };
    return of(0) * axis.x() + of(1) * axis.y() + of(2) * axis.z();
  };
  places_x = along(across);
  places_y = along(up);
  columns.resize(size_);
  findColumns(places_x, places_y, &columns);
  std::array<std::uint32_t, kSide * kSide + 1> begins{};
  for (const std::uint32_t column : columns) ++begins[column + 1];
  for (std::size_t i = 1; i < begins.size(); ++i) begins[i] += begins[i - 1];
  for (std::size_t i = 0; i < size_; ++i) {
    const std::uint32_t to = begins[columns[i]]++;
    number_[to] = other.number_[i];
    for (std::size_t k = 0; k < 6; ++k) values_[k][to] = other.values_[k][i];
  }
}

}  // namespace sunlit::light
