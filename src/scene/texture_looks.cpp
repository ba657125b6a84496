#include "scene/texture_looks.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "scene/color.h"

namespace sunlit::scene {

bool isGrey(const Texture& texture) {
  constexpr int kCompressed = 12;  // by as much a JPEG may tint a grey
  for (std::size_t i = 0; i < texture.rgba.size(); i += 4) {
    const auto [low, high] = std::minmax({texture.rgba[i], texture.rgba[i + 1], texture.rgba[i + 2]});
    if (high - low > kCompressed) return false;
  }
  return true;
}

bool leansLittle(const Texture& texture) {
  std::size_t sum = 0;
  for (std::size_t i = 2; i < texture.rgba.size(); i += 4) sum += texture.rgba[i];
  const double texels = static_cast<double>(texture.rgba.size()) / 4.0;
  return 2.0 * static_cast<double>(sum) / (255.0 * texels) - 1.0 >= 0.5;
}

Eigen::Array4f meanOf(const Texture& texture) {
  std::array<double, 256> linear;
  for (std::size_t i = 0; i < linear.size(); ++i) linear[i] = linearFromSrgb(static_cast<float>(i) / 255.0f);
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  double share = 0.0;
  for (std::size_t i = 0; i < texture.rgba.size(); i += 4) {
    const double alpha = texture.rgba[i + 3] / 255.0;
    sum += alpha *
           Eigen::Array3d(linear[texture.rgba[i]], linear[texture.rgba[i + 1]], linear[texture.rgba[i + 2]]);
    share += alpha;
  }
  Eigen::Array4f mean = Eigen::Array4f::Zero();
  if (share > 0.0) mean.head<3>() = (sum / share).cast<float>();
  mean[3] = static_cast<float>(4.0 * share / static_cast<double>(texture.rgba.size()));
  return mean;
}

}  // namespace sunlit::scene
