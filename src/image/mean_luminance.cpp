#include "sunlit/image/mean_luminance.h"

#include "finite_luminance.h"

namespace sunlit::image {

Eigen::Array3d meanLuminance(const LinearImage& picture) {
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  for (int y = 0; y < picture.height; ++y) {
    Eigen::Array3d of_row = Eigen::Array3d::Zero();
    for (int x = 0; x < picture.width; ++x) {
      const float* rgb = picture.at(x, y);
      of_row += Eigen::Array3f(finiteLuminance(rgb[0]), finiteLuminance(rgb[1]), finiteLuminance(rgb[2]))
                    .cast<double>();
    }
    sum += of_row;
  }
  return sum / (static_cast<double>(picture.width) * static_cast<double>(picture.height));
}

}  // namespace sunlit::image
