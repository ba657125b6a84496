#include "render/view.h"

#include "render/lens_canvas.h"

namespace sunlit::render {

Eigen::Vector3d View::throughLens(double u, double v) const {
  return lens->pixels()->at(u, v);
}

Eigen::Vector3d View::pixelRight() const {
  if (!lens) return ray(1.0, 0.0) - ray(0.0, 0.0);
  return map_from_optical.linear() * lens->pixels()->right(camera.cx, camera.cy);
}

Eigen::Vector3d View::pixelDown() const {
  if (!lens) return ray(0.0, 1.0) - ray(0.0, 0.0);
  return map_from_optical.linear() * lens->pixels()->down(camera.cx, camera.cy);
}

}  // namespace sunlit::render
