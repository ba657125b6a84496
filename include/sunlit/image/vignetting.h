/// How much less light a lens passes on towards the edge of the picture.
#pragma once

#include <vector>

#include "sunlit/image/images.h"
#include "sunlit/image/lens.h"
#include "sunlit/quantity/field.h"

namespace sunlit::image {

/// The default is a lens that lights the sensor evenly.
struct VignettingOptions {
  bool cos4 = false;
  double a1 = 0.0, a2 = 0.0, a3 = 0.0;

  bool none() const { return !cos4 && a1 == 0.0 && a2 == 0.0 && a3 == 0.0; }
};

inline std::vector<Field> fieldsOf(VignettingOptions& options) {
  const Range any{-10, 10};
  return {
      {"natural",
       choiceOf(&options.cos4, {"none", "cos4"}),
       "",
       {},
       "cos4: of the angle from the axis, the cosine to the fourth, as a plain lens has it"},
      {"a1", &options.a1, "", any, "measured, times that: 1 + a1 r² + a2 r⁴ + a3 r⁶, r = 1 in the corner"},
      {"a2", &options.a2, "", any, "see a1"},
      {"a3", &options.a3, "", any, "see a1; the whole must be from 0 to 2 all over the picture"}};
}

/// Throws std::invalid_argument naming key, value and what is allowed.
void validate(const VignettingOptions& options);

/// cos⁴ θ by the true ray of each pixel's middle, through the lens, and the polynomial of lensfun's model
/// "pa" by r, the distance from the principal point in parts of that of the farthest corner. Measured
/// polynomials hold all that a lens does, cos⁴ included.
class Vignetting {
 public:
  /// Throws std::invalid_argument as validate(), as Lens::widest(), and for cos⁴ before a lens that shows 90
  /// degrees from its axis or more, where it leaves nothing: such lenses are built otherwise.
  Vignetting(const Lens& lens, const VignettingOptions& options);

  const Lens& lens() const { return lens_; }
  bool none() const { return options_.none(); }
  /// The part of the light that reaches `pixel`, ≥ 0, at its middle.
  double at(const Eigen::Vector2d& pixel) const;
  /// Multiplies each pixel of `picture`, which is of the lens's size, by that. The same bits for any thread
  /// count.
  void apply(LinearImage* picture) const;

 private:
  Lens lens_;
  VignettingOptions options_;
  double corner_px_;          ///< from the principal point
  std::vector<float> parts_;  ///< of the pixels, by rows; empty: all 1
};

}  // namespace sunlit::image
