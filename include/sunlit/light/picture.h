/// Pictures: what a camera sees, made ready once a pose and lit once a condition.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <memory>
#include <vector>

#include "sunlit/image/images.h"
#include "sunlit/image/veiling_glare.h"
#include "sunlit/light/illumination.h"
#include "sunlit/light/surfaces.h"
#include "sunlit/light/visibility.h"
#include "sunlit/light/world.h"

namespace sunlit::light {

/// What a camera sees of a world at one pose.
struct PictureGeometry {
  Surfaces surfaces;
  std::shared_ptr<const Visibility> visibility;  ///< of the world, with its bodies where they stand
  /// Of each of World::bodies, in their order; or none, and they are not there.
  std::vector<Eigen::Isometry3d> map_from_body;
};

/// Geometry and all that light derives of it, for any sun and sky. PicturePreparer makes it.
class PreparedPicture {
 public:
  /// Nothing yet.
  PreparedPicture();
  ~PreparedPicture();
  PreparedPicture(PreparedPicture&&) noexcept;
  PreparedPicture& operator=(PreparedPicture&&) noexcept;

  /// Luminance of each pixel, cd/m²: the discs of sun and moon where rays reach them, lamps, light of the sky
  /// and of other surfaces as far as `light` and the world know it (else of the open sky by surface
  /// direction), emission, the air before all that, dark where no sky is open to it, and the sky with sun,
  /// moon and stars where no surface is seen. `light` is of the same world, or just a sky::Daylight.
  /// Parallel; the same bits for any thread count.
  image::LinearImage illuminate(const Illumination& light) const;
  /// Sun, moon and lamps as far as they are not in the picture, nor a bulb that glows where a lamp is, by the
  /// part of them that nothing hides from the camera: by rays, which begin `nearest_m` from it, and what
  /// glass and what blends evenly leave of the light. What only shows, such as surfaces that glow, is not
  /// among them.
  std::vector<image::LightOutside> lightsOutside(const Illumination& light, float nearest_m) const;

  const Surfaces& surfaces() const;
  /// Ends this picture, whose memory then serves the next one's geometry.
  Surfaces takeSurfaces();

 private:
  friend class PicturePreparer;
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// Prepares pictures of one world, pose after pose. One thread at a time may prepare; others may be in
/// pictures made before.
class PicturePreparer {
 public:
  /// Most rays of a closer look at the sky: see `final_gather` below.
  static constexpr int kMostRays = 16;

  /// `final_gather`, 0 … kMostRays: 0, and leaves, twigs and wires see the sky as baked; else, where light is
  /// baked, they look closer at it, with so many rays to each of its patches, and what they find is kept for
  /// the next poses. Throws std::invalid_argument naming key, value and range.
  /// `beside`: of the same triangles, in whichever state of their surfaces: what it finds with as many rays
  /// serves this one, and the other way round. Other threads may prepare by it meanwhile.
  explicit PicturePreparer(const World& world, int final_gather = 0, const PicturePreparer* beside = nullptr);
  ~PicturePreparer();
  PicturePreparer(const PicturePreparer&) = delete;
  PicturePreparer& operator=(const PicturePreparer&) = delete;

  /// Replaces `picture`, whose memory is used again. Parallel; the same bits for any number of threads and
  /// whatever was prepared before.
  void prepare(PictureGeometry geometry, PreparedPicture* picture);

  /// Places that the last look of `final_gather` had to cast rays from.
  std::size_t placesCast() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace sunlit::light
