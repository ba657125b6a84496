#include "light/reference/emitters.h"

#include <algorithm>
#include <cmath>

#include "sunlit/quantity/photometry.h"

namespace sunlit::light {

Emitters::Emitters(const Geometry& geometry) : geometry_(geometry) {
  for (std::uint32_t t = 0; t < geometry.triangles.size(); ++t) {
    const float luminance = luminanceOf(t);
    if (!(luminance > 0.0f)) continue;
    const auto& [a, b, c] = geometry.triangles[t];
    const Eigen::Vector3f ab = geometry.positions[b] - geometry.positions[a];
    const Eigen::Vector3f ac = geometry.positions[c] - geometry.positions[a];
    triangles_.push_back(t);
    powers_.push_back((powers_.empty() ? 0.0 : powers_.back()) +
                      static_cast<double>(luminance * 0.5f * ab.cross(ac).norm()));
  }
}

float Emitters::luminanceOf(std::uint32_t triangle) const {
  if (triangle >= geometry_.triangles.size()) return 0.0f;  // of what moves
  const scene::Material& material =
      geometry_.scene->materials[static_cast<std::size_t>(geometry_.materials[triangle])];
  const bool solid = material.alpha_mode == scene::AlphaMode::kOpaque;
  return solid && material.lamp_group.empty() ? material.emission.luminance() : 0.0f;
}

Emitters::Point Emitters::sample(const std::array<float, 3>& random) const {
  const double sought = static_cast<double>(random[0]) * powers_.back();
  const auto found = std::upper_bound(powers_.begin(), powers_.end() - 1, sought);
  const std::uint32_t triangle = triangles_[static_cast<std::size_t>(found - powers_.begin())];
  const float root = std::sqrt(random[1]);
  Point point;
  point.hit.triangle = triangle;
  point.hit.u = root * (1.0f - random[2]);
  point.hit.v = root * random[2];
  const auto& [a, b, c] = geometry_.triangles[triangle];
  point.position = (1.0f - point.hit.u - point.hit.v) * geometry_.positions[a] +
                   point.hit.u * geometry_.positions[b] + point.hit.v * geometry_.positions[c];
  return point;
}

float Emitters::density(const Hit& hit, const Eigen::Vector3f& towards, float distance_m) const {
  const float luminance = luminanceOf(hit.triangle);
  if (!(luminance > 0.0f)) return 0.0f;
  const float cosine = std::abs(geometry_.planes[hit.triangle].normal.dot(towards));
  return luminance / static_cast<float>(powers_.back()) * distance_m * distance_m / std::max(cosine, 1e-6f);
}

}  // namespace sunlit::light
