/// What a lens sees, drawn by rasterizers that know pinholes alone.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "render/rasterizer.h"
#include "sunlit/image/lens.h"
#include "sunlit/light/pixel_rays.h"

namespace sunlit::render {

struct Seen;

/// Directions are moved, not pixels. Rasterizers draw which triangle is seen on one pinhole picture, or on up
/// to five faces of a cube, in which samples lie at least as dense as in the picture wanted. Each sample of
/// that has its own true ray: among the triangles of the four drawn samples about it, it sees the nearest
/// that its ray passes through. Where it meets that triangle's plane is exact; what none of the four shows,
/// less than a sample wide, may be missed, and the edges of textures that cut holes are those of the nearest
/// drawn sample.
class LensCanvas {
 public:
  /// Of two rows and columns at least. `lens` shows all of its picture, see image::Lens::widest(), but for
  /// less than half a pixel at its edge.
  LensCanvas(const image::Lens& lens, int supersampling);
  /// Of `rows`, the lens of some rows of the picture of `whole` from `first` on, two at least: keeps no rays
  /// of its own.
  LensCanvas(const LensCanvas& whole, const image::Lens& rows, int first);

  const std::shared_ptr<const light::PixelRays>& pixels() const { return pixels_; }
  /// Of a sample of the picture, in the optical frame, of depth 1 m.
  const Eigen::Vector3f& ray(int column, int row) const { return rays_[index(column, row)]; }
  /// Of all rays that are kept here.
  std::size_t bytes() const;

  /// A picture by a pinhole, one sample a pixel.
  struct Face {
    image::PinholeCamera camera;
    Eigen::Matrix3d optical_from_face;
  };
  const std::vector<Face>& faces() const { return faces_; }

  /// What the rasterizer drew on each face; of no use after draw().
  using Drawn = std::vector<std::vector<Sample>>;
  /// Draws `seen`, but for its samples, which go to `samples`. Whoever has several of these keeps one
  /// `drawn`.
  void draw(Rasterizer* rasterizer, const Seen& seen, Drawn* drawn, std::vector<Sample>* samples) const;

 private:
  /// The four drawn samples about a ray, by the first of them, and which is nearest: to find them costs less
  /// than to keep them.
  struct Cell {
    Eigen::Vector3d ray;
    std::uint32_t first;
    std::uint8_t face, nearest;
  };
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }
  std::size_t samples() const { return index(0, rows_); }
  std::size_t faceOf(const Eigen::Vector3d& ray) const;
  bool needsCube() const;
  void layOutFaces();
  void findRays();
  Cell cellOf(const Eigen::Vector3d& ray) const;
  Sample sampleAt(const Seen& seen, const Drawn& drawn, const Cell& cell) const;
  Sample atEdge(const Seen& seen, const Drawn& drawn, const Cell& cell) const;
  Sample drawnNearest(const Seen& seen, const Drawn& drawn, const Cell& cell) const;

  std::shared_ptr<const light::PixelRays> pixels_;
  int supersampling_, columns_, rows_;
  std::shared_ptr<const std::vector<Eigen::Vector3f>> found_;  ///< null: those of pixels_, one sample each
  const Eigen::Vector3f* rays_ = nullptr;                      ///< of samples, by rows
  std::vector<Face> faces_;
};

}  // namespace sunlit::render
