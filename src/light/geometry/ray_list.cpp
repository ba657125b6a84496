#include "light/geometry/ray_list.h"

#include <algorithm>

namespace sunlit::light {
namespace {

/// Columns, there and back in every second row: fewer of few rays, which would be alone in theirs.
constexpr std::uint32_t kMostSide = 32, kFewSide = 8;
constexpr std::size_t kFew = 512;

using Places = Eigen::ArrayXf;

/// The column of each ray, of side × side.
void findColumns(const Places& x, const Places& y, std::uint32_t side, std::vector<std::uint32_t>* columns) {
  const float low_x = x.minCoeff(), low_y = y.minCoeff();
  const float widest = std::max({x.maxCoeff() - low_x, y.maxCoeff() - low_y, 1e-3f});
  const float scale = (static_cast<float>(side) - 0.5f) / widest;
  for (std::size_t i = 0; i < columns->size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    const auto column = static_cast<std::uint32_t>(static_cast<std::int32_t>((x[at] - low_x) * scale));
    const auto row = static_cast<std::uint32_t>(static_cast<std::int32_t>((y[at] - low_y) * scale));
    (*columns)[i] = row * side + (row % 2 == 0 ? column : side - 1 - column);
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
  const std::uint32_t side = size_ < kFew ? kFewSide : kMostSide;
  findColumns(places_x, places_y, side, &columns);
  std::array<std::uint32_t, kMostSide * kMostSide + 1> begins;
  const std::size_t count_of_columns = side * side;
  std::fill_n(begins.begin(), count_of_columns + 1, 0u);
  for (const std::uint32_t column : columns) ++begins[column + 1];
  for (std::size_t i = 1; i <= count_of_columns; ++i) begins[i] += begins[i - 1];
  for (std::size_t i = 0; i < size_; ++i) {
    const std::uint32_t to = begins[columns[i]]++;
    number_[to] = other.number_[i];
    for (std::size_t k = 0; k < 6; ++k) values_[k][to] = other.values_[k][i];
  }
}

}  // namespace sunlit::light
