/// What `compare_light` leaves in its folder.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "sunlit/image/images.h"
#include "sunlit/light/luminance_error.h"
#include "sunlit/light/surfaces.h"
#include "sunlit/scene/scene.h"

namespace sunlit::tools {

/// One view under one sun.
struct ComparisonRow {
  int view = 0;
  std::string sky;
  double illuminance_lx = 0.0;  ///< of level, open ground
  light::LuminanceError error;
  double flip = 0.0;  ///< mean of image::hdrFlip()
};

/// Which materials the error comes from, over all views and skies.
class ErrorByMaterial {
 public:
  /// Each pixel counts for the material that fills most of it.
  void add(const light::Surfaces& surfaces, const image::Picture<float, 1>& errors);
  /// materials.md: those that add most to the mean error first.
  void write(const std::string& folder, const scene::Scene& scene) const;

 private:
  struct Sum {
    std::size_t pixels = 0;
    double absolute = 0.0, positive_and_negative = 0.0;
  };
  std::map<std::int32_t, Sum> sums_;
};

/// table.csv and table.md in `folder`: every row, and their means by sky. A row without pixels has no errors:
/// nothing in the one, – in the other.
void writeTables(const std::string& folder, const std::vector<ComparisonRow>& rows);

/// Both pictures as a camera would take them, and the signed error beside them: red where `fast` is too
/// bright, blue where it is too dark, black for none, full at 50 %.
image::Rgb8Image sideBySide(const image::LinearImage& fast, const image::LinearImage& traced,
                            const image::Picture<float, 1>& errors);

}  // namespace sunlit::tools
