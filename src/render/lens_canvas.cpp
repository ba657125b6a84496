#include "render/lens_canvas.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "render/resolve.h"

namespace sunlit::render {
namespace {

/// From the axis, up to which one pinhole picture is not much larger than what is wanted.
constexpr double kOnePinhole_deg = 70.0;
/// Pixels from one place to the next at which it is looked at how dense samples must lie.
constexpr int kLookEvery = 4;
/// Samples that a face reaches beyond the rays that it serves, so that each has four about it.
constexpr int kMargin = 2;
/// Samples a side of a face at most; where more were needed, as before lenses that hardly exist, less dense.
constexpr double kLargestFace = 16000.0;

Eigen::Matrix3d turned(double across_deg, double down_deg) {
  return (Eigen::AngleAxisd(across_deg * kRadPerDeg, Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(down_deg * kRadPerDeg, Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

/// Where a ray meets the plane at depth 1 of a face.
Eigen::Vector2d onFace(const Eigen::Matrix3d& optical_from_face, const Eigen::Vector3d& ray) {
  const Eigen::Vector3d there = optical_from_face.transpose() * ray;
  return there.head<2>() / there.z();
}

constexpr double kUnknown = 1e300;

/// What the rays that a face serves need of it.
struct Extent {
  Eigen::Array2d least = Eigen::Array2d::Constant(1e300), most = Eigen::Array2d::Constant(-1e300);
  double densest = kUnknown;  ///< the smallest area at depth 1 that is one sample of the picture

  void add(const Eigen::Vector2d& at) {
    least = least.min(at.array());
    most = most.max(at.array());
  }
};

}  // namespace

LensCanvas::LensCanvas(const image::Lens& lens, int supersampling)
    : pixels_(std::make_shared<const light::PixelRays>(lens)),
      supersampling_(supersampling),
      columns_(lens.camera().width * supersampling),
      rows_(lens.camera().height * supersampling) {
  if (supersampling > 1) findRays();
  rays_ = found_ ? found_->data() : pixels_->row(0);
  layOutFaces();
}

LensCanvas::LensCanvas(const LensCanvas& whole, const image::Lens& rows, int first)
    : pixels_(std::make_shared<const light::PixelRays>(*whole.pixels_, rows, first)),
      supersampling_(whole.supersampling_),
      columns_(whole.columns_),
      rows_(rows.camera().height * supersampling_),
      found_(whole.found_),
      rays_(&whole.ray(0, first * supersampling_)) {
  layOutFaces();
}

void LensCanvas::findRays() {
  const auto found = std::make_shared<std::vector<Eigen::Vector3f>>(samples());
  const image::Lens& lens = pixels_->lens();
  const auto pixel = [&](int sample) { return (sample + 0.5) / supersampling_ - 0.5; };
  tbb::parallel_for(0, rows_, [&](int row) {
    for (int column = 0; column < columns_; ++column)
      (*found)[index(column, row)] = lens.unproject({pixel(column), pixel(row)}).value().cast<float>();
  });
  found_ = found;
}

std::size_t LensCanvas::bytes() const {
  const image::PinholeCamera& camera = pixels_->lens().camera();
  const auto pixels = static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height);
  return (pixels + (found_ ? found_->size() : 0)) * sizeof(Eigen::Vector3f);
}

std::size_t LensCanvas::faceOf(const Eigen::Vector3d& ray) const {
  if (faces_.size() == 1) return 0;
  const double x = std::abs(ray.x()), y = std::abs(ray.y());
  if (ray.z() >= std::max(x, y)) return 0;
  if (x >= y) return ray.x() > 0.0 ? 1 : 2;
  return ray.y() > 0.0 ? 3 : 4;
}

/// Whether one pinhole would have to show too much.
bool LensCanvas::needsCube() const {
  const auto narrowest = static_cast<float>(std::cos(kOnePinhole_deg * kRadPerDeg));
  return std::any_of(rays_, rays_ + samples(),
                     [&](const Eigen::Vector3f& ray) { return ray.z() < narrowest * ray.norm(); });
}

void LensCanvas::layOutFaces() {
  faces_.push_back({{}, Eigen::Matrix3d::Identity()});
  if (needsCube()) {
    for (const auto& [across, down] : {std::pair{90.0, 0.0}, {-90.0, 0.0}, {0.0, -90.0}, {0.0, 90.0}})
      faces_.push_back({{}, turned(across, down)});
  }
  std::vector<Extent> extents(faces_.size());
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const Eigen::Vector3d here = ray(column, row).cast<double>();
      const std::size_t f = faceOf(here);
      const Eigen::Vector2d at = onFace(faces_[f].optical_from_face, here);
      extents[f].add(at);
      const bool is_looked_at = column % kLookEvery == 0 && row % kLookEvery == 0;
      if (!is_looked_at && extents[f].densest < kUnknown) continue;
      const Eigen::Vector3d right = ray(column + (column + 1 < columns_ ? 1 : -1), row).cast<double>();
      const Eigen::Vector3d down = ray(column, row + (row + 1 < rows_ ? 1 : -1)).cast<double>();
      Eigen::Matrix2d sides;
      sides << onFace(faces_[f].optical_from_face, right) - at,
          onFace(faces_[f].optical_from_face, down) - at;
      extents[f].densest = std::min(extents[f].densest, std::abs(sides.determinant()));
    }
  }
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const Extent& extent = extents[f];
    Face& face = faces_[f];
    if (extent.least.x() > extent.most.x()) continue;  // the picture does not reach it
    const double widest = (extent.most - extent.least).maxCoeff();
    const double focal = std::min(1.0 / std::sqrt(extent.densest), kLargestFace / std::max(widest, 1e-9));
    const Eigen::Array2i size = ((extent.most - extent.least) * focal).ceil().cast<int>() + 2 * kMargin;
    const Eigen::Array2d middle = kMargin - extent.least * focal;
    face.camera = {size.x(), size.y(), focal, focal, middle.x(), middle.y()};
  }
}

LensCanvas::Cell LensCanvas::cellOf(const Eigen::Vector3d& ray) const {
  const std::size_t f = faceOf(ray);
  const Face& face = faces_[f];
  const Eigen::Vector2d at = onFace(face.optical_from_face, ray);
  const double column = face.camera.fx * at.x() + face.camera.cx;
  const double row = face.camera.fy * at.y() + face.camera.cy;
  const int left = static_cast<int>(std::floor(column)), top = static_cast<int>(std::floor(row));
  const int nearest = (column - left > 0.5 ? 1 : 0) + (row - top > 0.5 ? 2 : 0);
  return {ray, static_cast<std::uint32_t>(top * face.camera.width + left), static_cast<std::uint8_t>(f),
          static_cast<std::uint8_t>(nearest)};
}

void LensCanvas::draw(Rasterizer* rasterizer, const Seen& seen, Drawn* drawn,
                      std::vector<Sample>* samples) const {
  drawn->resize(std::max(drawn->size(), faces_.size()));
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    if (faces_[f].camera.fx == 0.0) continue;
    View view = seen.view;
    view.lens = nullptr;
    view.camera = faces_[f].camera;
    view.supersampling = 1;
    view.map_from_optical.linear() = seen.view.map_from_optical.linear() * faces_[f].optical_from_face;
    rasterizer->draw(view, seen.bodies, &(*drawn)[f]);
  }
  samples->resize(this->samples());
  tbb::parallel_for(0, rows_, [&](int row) {
    for (std::size_t i = index(0, row); i < index(0, row + 1); ++i)
      (*samples)[i] = sampleAt(seen, *drawn, cellOf(rays_[i].cast<double>()));
  });
}

Sample LensCanvas::sampleAt(const Seen& seen, const Drawn& drawn, const Cell& cell) const {
  const Sample* const top = &drawn[cell.face][cell.first];
  const Sample* const bottom = top + faces_[cell.face].camera.width;
  const std::uint32_t triangle = top[0].triangle;
  if (top[1].triangle != triangle || bottom[0].triangle != triangle || bottom[1].triangle != triangle)
    return atEdge(seen, drawn, cell);
  if (triangle == 0) return {0, static_cast<float>(seen.view.far_m)};
  const double depth = planeDepth(seen, triangle - 1, seen.view.map_from_optical.linear() * cell.ray);
  // Corners that rasterizers round may let it pass beside a triangle that is seen from the side.
  if (!(depth > 0.0 && depth < seen.view.far_m)) return drawnNearest(seen, drawn, cell);
  return {triangle, static_cast<float>(depth)};
}

Sample LensCanvas::atEdge(const Seen& seen, const Drawn& drawn, const Cell& cell) const {
  const Sample* const top = &drawn[cell.face][cell.first];
  const Sample* const bottom = top + faces_[cell.face].camera.width;
  const std::array<std::uint32_t, 4> about = {top[0].triangle, top[1].triangle, bottom[0].triangle,
                                              bottom[1].triangle};
  const std::uint32_t nearest = about[cell.nearest];
  const Eigen::Vector3d ray = seen.view.map_from_optical.linear() * cell.ray;
  double least = std::numeric_limits<double>::infinity();
  std::uint32_t seen_first = 0;
  bool sky = false;
  for (std::size_t k = 0; k < about.size(); ++k) {
    const std::uint32_t triangle = about[k];
    sky |= triangle == 0;
    const bool known = std::find(about.begin(), about.begin() + static_cast<std::ptrdiff_t>(k), triangle) !=
                       about.begin() + static_cast<std::ptrdiff_t>(k);
    if (triangle == 0 || known) continue;
    if (triangle != nearest && isMasked(seen.look(seen.material(triangle - 1)))) continue;
    const double depth = planeDepth(seen, triangle - 1, ray);
    if (!(depth > 0.0 && depth < least) || !passesThrough(seen, triangle - 1, ray)) continue;
    least = depth;
    seen_first = triangle;
  }
  if (seen_first != 0) return {seen_first, static_cast<float>(least)};
  if (sky) return {0, static_cast<float>(seen.view.far_m)};
  return drawnNearest(seen, drawn, cell);
}

/// The nearest drawn sample, at its own depth.
Sample LensCanvas::drawnNearest(const Seen& seen, const Drawn& drawn, const Cell& cell) const {
  const Face& face = faces_[cell.face];
  const Sample& nearest =
      drawn[cell.face][cell.first + (cell.nearest & 1u) +
                       (cell.nearest >> 1) * static_cast<std::uint32_t>(face.camera.width)];
  if (nearest.sky()) return {0, static_cast<float>(seen.view.far_m)};
  const double along = face.optical_from_face.col(2).dot(cell.ray);
  return {nearest.triangle, static_cast<float>(static_cast<double>(nearest.depth) / along)};
}

}  // namespace sunlit::render
