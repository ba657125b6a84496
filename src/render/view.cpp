#include "render/view.h"

#include "render/lens_canvas.h"

namespace sunlit::render {

Eigen::Vector3d View::throughLens(double u, double v) const {
  return lens->pixels()->at(u, v);
}

Eigen::Vector3d View::aboutAxis(const Eigen::Vector2d& step) const {
  const Eigen::Array2d axis(camera.cx, camera.cy), last(camera.width - 1, camera.height - 1);
  const light::PixelRays& pixels = *lens->pixels();
  const bool is_beside = (axis < 0.0).any() || (axis > last).any();  // as of rows that see at one moment
  const auto look = [&](const Eigen::Vector2d& pixel) {
    const Eigen::Vector3d known = pixels.at(pixel.x(), pixel.y());
    return is_beside ? pixels.lens().unproject(pixel).value_or(known) : known;
  };
  return map_from_optical.linear() * (look(axis.matrix() + 0.5 * step) - look(axis.matrix() - 0.5 * step));
}

Eigen::Vector3d View::pixelRight() const {
  return lens ? aboutAxis({1.0, 0.0}) : ray(1.0, 0.0) - ray(0.0, 0.0);
}

Eigen::Vector3d View::pixelDown() const {
  return lens ? aboutAxis({0.0, 1.0}) : ray(0.0, 1.0) - ray(0.0, 0.0);
}

}  // namespace sunlit::render
