/// What a camera would see: geometry once per pose, light once per pose and condition.
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <string>
#include <vector>

#include "sunlit/image/camera.h"
#include "sunlit/image/images.h"
#include "sunlit/image/lens.h"
#include "sunlit/image/veiling_glare.h"
#include "sunlit/light/illumination.h"
#include "sunlit/light/picture.h"
#include "sunlit/light/surfaces.h"
#include "sunlit/light/world.h"
#include "sunlit/quantity/field.h"
#include "sunlit/quantity/motion.h"
#include "sunlit/render/rasterizer_kind.h"
#include "sunlit/scene/scene.h"

namespace sunlit::render {

struct RenderOptions {
  image::PinholeCamera camera;
  image::Distortion distortion;  ///< of its lens; one that bends nothing makes a pinhole of it
  int supersampling = 2;         ///< 2 is four samples a pixel
  double near_m = 0.05;
  double far_m = 20000.0;  ///< above near_m
  double texture_lod_bias = 0.0;
  /// 0: the sky is seen as baked. Else leaves, twigs and wires look closer, with so many rays a patch, where
  /// light is baked. What that brings and costs: README.md.
  int final_gather = 0;
  RasterizerKind rasterizer = defaultRasterizer();
};

inline std::vector<Field> fieldsOf(RenderOptions& options) {
  return joined(
      {fieldsOf(options.camera),
       {{"supersampling", &options.supersampling, "", {1, 4}, "samples per pixel and axis: anti-aliasing"},
        {"near", &options.near_m, "m", Range::above(0, 1e6), "nearest visible depth"},
        {"far", &options.far_m, "m", Range::above(0, 1e7), "farthest visible depth"},
        {"texture_lod_bias", &options.texture_lod_bias, "levels", {-4, 4}, "of the mipmaps"},
        {"final_gather",
         &options.final_gather,
         "",
         {0, light::PicturePreparer::kMostRays},
         "leaves, twigs and wires look closer at the sky: rays to each of its patches; 0: as baked"},
        {"rasterizer",
         choiceOf(&options.rasterizer, rasterizerNames()),
         "",
         {},
         "what draws: OpenGL by OSMesa or by EGL, or our own; their pictures hardly differ"}}});
}

/// Throws std::invalid_argument naming key, value and range.
void validate(const RenderOptions& options);

/// map_from_body of each of light::World::bodies, in their order; or none, and they are not there.
using BodyPlaces = std::vector<Eigen::Isometry3d>;

/// How a picture is taken while its camera moves.
struct UnderWay {
  Motion motion;
  /// From row to row, ≥ 0. The middle of the first row's exposure is the moment of the pose that look() was
  /// called with.
  double line_delay_s = 0.0;
  double exposure_s = 0.0;  ///< of each row, ≥ 0
  int exposures = 16;       ///< pictures at most that a smeared one is the mean of, ≥ 1

  bool none() const { return motion.none() || (line_delay_s == 0.0 && exposure_s == 0.0); }
};

/// One thread at a time may call look() or lookAhead(). All calls are parallel inside, and give the same bits
/// for any thread count.
class Renderer {
 public:
  /// Throws std::invalid_argument by validate(), and std::runtime_error if the rasterizer cannot start here,
  /// naming those that can.
  Renderer(const light::World& world, const RenderOptions& options);
  /// One world with its surfaces in several states, as light::weathered() makes them: what is drawn serves
  /// all. Throws std::invalid_argument where there is none.
  Renderer(const std::vector<light::World>& states, const RenderOptions& options);
  /// A world of its own, in which surfaces see the whole sky that they face.
  Renderer(std::shared_ptr<const scene::Scene> scene, const RenderOptions& options);
  /// Another camera in the states of `beside`, or only in the first one, with which it shares what their
  /// textures became, and what final_gather found, if it is the same.
  enum class States { kAll, kFirst };
  Renderer(const Renderer& beside, const RenderOptions& options, States states);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  /// Draws the geometry seen from `map_from_optical` (z forward, x right, y down). All later calls speak of
  /// this pose. `map_from_body` says where each of the world's bodies stands; without it they are not there.
  void look(const Eigen::Isometry3d& map_from_optical, const BodyPlaces& map_from_body = {});
  /// Draws a pose that look() will be called with later, which then costs nothing. light() and depth() still
  /// speak of the present pose, and other threads may be in them meanwhile.
  void lookAhead(const Eigen::Isometry3d& map_from_optical, const BodyPlaces& map_from_body = {});
  /// Luminance of each pixel, cd/m². `light` is of this renderer's world, in its state number `state`, or
  /// just a sky::Daylight.
  image::LinearImage light(const light::Illumination& light, std::size_t state = 0) const;
  /// The same while the camera moves, its bodies with it: the mean of several pictures, evenly over the
  /// exposure, each of bands of rows that see at moments of their own. A picture of a row is off by an eighth
  /// of a pixel at most where nineteen twentieths of the picture run by 16 px from its first row to its last;
  /// faster ones in proportion. light() where nothing of it reaches a pixel.
  image::LinearImage light(const light::Illumination& light, std::size_t state, const UnderWay& way);
  /// Of how many pictures that one is the mean.
  int exposures(const UnderWay& way) const;
  /// What of `light` shines on the lens from beside the picture, as PreparedPicture::lightsOutside(); what is
  /// too near to be drawn hides nothing.
  std::vector<image::LightOutside> lightsOutside(const light::Illumination& light) const;
  /// Depth of what the centre of each pixel sees, m along the optical axis; before a lens that is
  /// image::Lens::wide(), where that would be 0 at the side, the distance from the camera. NaN for sky.
  image::DepthImage depth() const;

  /// What light() lights: valid until the next look().
  const light::Surfaces& surfaces(std::size_t state = 0) const;

  const RenderOptions& options() const;
  /// Which rasterizer draws, and on what, such as "osmesa: llvmpipe (LLVM 15.0.6, 256 bits)".
  std::string rasterizer() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace sunlit::render
