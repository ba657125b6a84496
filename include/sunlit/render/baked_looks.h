/// What only this renderer knows of surfaces, put into textures for others.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "sunlit/quantity/field.h"
#include "sunlit/scene/scene.h"

namespace sunlit::render {

struct BakedLooksOptions {
  double texel_m = 0.02;
  /// Where it will be looked at from, m in `map`: beyond kNear_m from all of these, texels grow with the
  /// distance. Empty: anywhere.
  std::vector<Eigen::Vector3d> eyes;
};

inline std::vector<Field> fieldsOf(BakedLooksOptions& options) {
  return {{"texel", &options.texel_m, "m", {0.001, 10}, "of fractal detail and vertex colours, in textures"}};
}

/// A scene without scene::Detail and vertex colours. Opaque surfaces that have them get a texture of their
/// own: triangles, two by two where they lie in a plane, side by side on pages. Finer where their own
/// texture is finer, to a quarter of the texel. Others, cut out, blending or of glass, keep their texture and
/// are tinted by triangle, in steps of 1/32 of the root of a colour.
class BakedLooks {
 public:
  static constexpr double kNear_m = 10.0;
  static constexpr int kLongestSide = 8192;                   ///< of a page, px
  static constexpr std::size_t kMost = std::size_t{1} << 29;  ///< texels of all pages

  /// Plans the pages. Keeps a reference to `scene`. Throws std::invalid_argument naming a texel that fits
  /// where they would have more than kMost texels.
  BakedLooks(const scene::Scene& scene, const BakedLooksOptions& options);
  ~BakedLooks();

  std::size_t pages() const;
  std::size_t texels() const;  ///< of all pages
  /// What became coarser, brighter or plain on the way, a line a kind.
  const std::vector<std::string>& notes() const;

  /// `done` takes the share of it, 0 … 1, on one thread at a time; may be empty. The same bits for any number
  /// of threads.
  scene::Scene make(const std::function<void(double share)>& done) const;

 private:
  struct Plan;
  std::unique_ptr<const Plan> plan_;
};

}  // namespace sunlit::render
