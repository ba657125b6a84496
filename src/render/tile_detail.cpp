#include "render/tile_detail.h"

#include <algorithm>

namespace sunlit::render {
namespace {

/// Fills up DetailPoints and hands out the sums when they are full.
class Batch {
 public:
  Batch(const DetailOctaves& octaves, DetailBand band) : octaves_(octaves), band_(band) {}

  void add(const Eigen::Vector3f& point, float footprint, float* sum) {
    points_.x[count_] = point.x();
    points_.y[count_] = point.y();
    points_.z[count_] = point.z();
    points_.footprint[count_] = footprint;
    targets_[count_++] = sum;
    if (count_ == DetailPoints::kCount) flush();
  }

  void flush() {
    if (count_ == 0) return;
    for (std::size_t i = count_; i < DetailPoints::kCount; ++i) {
      points_.x[i] = points_.x[0];
      points_.y[i] = points_.y[0];
      points_.z[i] = points_.z[0];
      points_.footprint[i] = points_.footprint[0];
    }
    std::array<float, DetailPoints::kCount> sums;
    sumOctaves(octaves_, band_, points_, &sums);
    for (std::size_t i = 0; i < count_; ++i) *targets_[i] = sums[i];
    count_ = 0;
  }

 private:
  const DetailOctaves& octaves_;
  DetailBand band_;
  DetailPoints points_;
  std::array<float*, DetailPoints::kCount> targets_;
  std::size_t count_ = 0;
};

}  // namespace

SceneDetail::SceneDetail(const scene::Scene& scene, const View& view)
    : octaves(scene.materials.size()), tints(scene.materials.size()) {
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const scene::Detail& detail = scene.materials[i].detail;
    tints[i] = detail.tint;
    if (detail.contrast > 0.0f) octaves[i].emplace(detail, view.eye());
  }
  const Eigen::Vector3d origin = view.ray(0.0, 0.0);
  sample_right = ((view.ray(1.0, 0.0) - origin) / view.supersampling).cast<float>();
  sample_down = ((view.ray(0.0, 1.0) - origin) / view.supersampling).cast<float>();
}

void TileDetail::add(const Entry& entry) {
  // Seen exactly from the side, a surface has no finite footprint.
  constexpr float kLargest_m = 1e9f;
  const float footprint = entry.footprint < kLargest_m ? std::max(entry.footprint, 1e-9f) : kLargest_m;
  items_.push_back({entry.surface, entry.material, footprint, entry.samples,
                    static_cast<std::uint32_t>(relatives_.size()), 0.0f});
  relatives_.insert(relatives_.end(), entry.relatives, entry.relatives + entry.samples);
  albedos_.insert(albedos_.end(), entry.albedos, entry.albedos + entry.samples);
}

void TileDetail::evaluate(const DetailOctaves& octaves, std::size_t begin, std::size_t end) {
  Batch coarse(octaves, DetailBand::kCoarse), fine(octaves, DetailBand::kFine);
  for (std::size_t i = begin; i < end; ++i) {
    Item& item = items_[i];
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    for (std::uint32_t k = item.first_sample; k < item.first_sample + item.samples; ++k) {
      sum += relatives_[k];
      fine.add(relatives_[k], item.footprint, &fine_[k]);
    }
    coarse.add(sum / static_cast<float>(item.samples), item.footprint, &item.coarse);
  }
  coarse.flush();
  fine.flush();
}

void TileDetail::apply(const SceneDetail& scene, std::vector<light::Surface>* surfaces) {
  fine_.resize(relatives_.size());
  std::stable_sort(items_.begin(), items_.end(),
                   [](const Item& a, const Item& b) { return a.material < b.material; });
  for (std::size_t begin = 0, end = 0; begin < items_.size(); begin = end) {
    const std::int32_t material = items_[begin].material;
    while (end < items_.size() && items_[end].material == material) ++end;
    evaluate(*scene.octaves[static_cast<std::size_t>(material)], begin, end);
  }
  for (const Item& item : items_) {
    const Eigen::Array3f& tint = scene.tints[static_cast<std::size_t>(item.material)];
    Eigen::Array3f sum = Eigen::Array3f::Zero();
    for (std::uint32_t k = item.first_sample; k < item.first_sample + item.samples; ++k) {
      sum += (albedos_[k] * (1.0f + tint * (item.coarse + fine_[k]))).max(0.0f).min(1.0f);
    }
    (*surfaces)[item.surface].albedo = sum / static_cast<float>(item.samples);
  }
  items_.clear();
  relatives_.clear();
  albedos_.clear();
}

}  // namespace sunlit::render
