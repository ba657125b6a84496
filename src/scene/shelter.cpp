#include "sunlit/scene/shelter.h"

#include "scene/top_heights.h"

namespace sunlit::scene {

Shelter::Shelter(const Shape& shape, const std::vector<Material>& materials)
    : tops_(std::make_unique<const TopHeights>(shape, materials)) {}
Shelter::~Shelter() = default;

bool Shelter::open(const Eigen::Vector3d& place) const {
  if (tops_->empty()) return true;
  const TopHeights::Cell cell = tops_->cellAt(place.head<2>().cast<float>());
  const int column = cell.column + (cell.right < 0.5f ? 0 : 1), row = cell.row + (cell.up < 0.5f ? 0 : 1);
  return tops_->at(column, row) <= static_cast<float>(place.z());  // a sheet of a millimetre is a roof
}

}  // namespace sunlit::scene
