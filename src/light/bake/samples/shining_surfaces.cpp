#include "light/bake/samples/shining_surfaces.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "light/geometry/cutout.h"
#include "light/shading/reflectances.h"
#include "sunlit/light/lamps.h"
#include "sunlit/light/surfaces.h"

namespace sunlit::light {
namespace {

/// A triangle that shines unevenly is cut into the square of so many pieces, as long as all of them are not
/// more than that.
constexpr int kAcross = 8;
constexpr double kMostPieces = 1e6;

/// The parts of a triangle, by (u, v) of their corners: across² of them.
std::vector<std::array<Eigen::Vector2f, 3>> partsOf(int across) {
  std::vector<std::array<Eigen::Vector2f, 3>> parts;
  const float step = 1.0f / static_cast<float>(across);
  const Eigen::Vector2f right(step, 0.0f), up(0.0f, step);
  for (int i = 0; i < across; ++i) {
    for (int j = 0; i + j < across; ++j) {
      const Eigen::Vector2f at = static_cast<float>(i) * right + static_cast<float>(j) * up;
      parts.push_back({at, at + right, at + up});
      if (i + j + 1 < across) parts.push_back({at + right, at + right + up, at + up});
    }
  }
  return parts;
}

bool shines(const scene::Material& material) {
  return glows(material, {});  // whatever lamps burn
}

/// How much of a triangle is there, where it is cut out or blends.
class Solidity {
 public:
  explicit Solidity(const Geometry& geometry) : cutouts_(geometry) {
    const std::vector<std::uint32_t>& masked = cutouts_.maskedTriangles();
    for (std::uint32_t i = 0; i < masked.size(); ++i) number_.emplace(masked[i], i);
  }

  /// 0 … 1, of a part by (u, v) of its corners: by sixteen points of it.
  float share(std::uint32_t triangle, const std::array<Eigen::Vector2f, 3>& part) const {
    const auto found = number_.find(triangle);
    if (found == number_.end()) return 1.0f;
    constexpr int kSteps = 4;
    int solid = 0;
    for (const auto& [a, b, c] : partsOf(kSteps)) {
      const Eigen::Vector2f middle = (a + b + c) / 3.0f;
      const Eigen::Vector2f at =
          part[0] + middle.x() * (part[1] - part[0]) + middle.y() * (part[2] - part[0]);
      solid += cutouts_.solid(found->second, at.x(), at.y()) ? 1 : 0;
    }
    return static_cast<float>(solid) / static_cast<float>(kSteps * kSteps);
  }

 private:
  Cutouts cutouts_;
  std::unordered_map<std::uint32_t, std::uint32_t> number_;  ///< among the masked ones
};

}  // namespace

std::vector<AreaLights::Piece> shiningPieces(const Geometry& geometry,
                                             const std::vector<TriangleTraits>& traits) {
  std::vector<AreaLights::Piece> pieces;
  const std::vector<scene::Material>& materials = geometry.scene->materials;
  if (std::none_of(materials.begin(), materials.end(), shines)) return pieces;
  const Reflectances reflectances(geometry);
  const Solidity solidity(geometry);
  std::vector<std::uint32_t> shining;
  std::size_t uneven = 0;
  const auto materialOf = [&](std::uint32_t t) -> const scene::Material& {
    return geometry.scene->materials[static_cast<std::size_t>(geometry.materials[t])];
  };
  const auto isUneven = [&](std::uint32_t t) {
    return materialOf(t).emission_map.given() || materialOf(t).alpha_mode != scene::AlphaMode::kOpaque;
  };
  for (std::uint32_t t = 0; t < geometry.triangles.size(); ++t) {
    if (!shines(materialOf(t))) continue;
    shining.push_back(t);
    uneven += isUneven(t) ? 1 : 0;
  }
  const double each = std::sqrt(kMostPieces / static_cast<double>(std::max<std::size_t>(uneven, 1)));
  const int most_across = std::clamp(static_cast<int>(each), 1, kAcross);
  for (const std::uint32_t t : shining) {
    const scene::Material& material = materialOf(t);
    const auto& corners = geometry.triangles[t];
    const Eigen::Vector3f &a = geometry.positions[corners[0]], &b = geometry.positions[corners[1]],
                          &c = geometry.positions[corners[2]];
    const int across = isUneven(t) ? most_across : 1;
    for (const auto& part : partsOf(across)) {
      AreaLights::Piece piece;
      Reflectances::Part corners_of_part;
      for (Eigen::Index k = 0; k < 3; ++k) {
        const Eigen::Vector2f& at = part[static_cast<std::size_t>(k)];
        // Exact at corners: bodies are told by those that their triangles share.
        piece.corner[static_cast<std::size_t>(k)] = (1.0f - at.sum()) * a + at.x() * b + at.y() * c;
        corners_of_part.col(k) << 1.0f - at.sum(), at.x(), at.y();
      }
      piece.normal = geometry.planes[t].normal;
      piece.luminance = solidity.share(t, part) * reflectances.emission(t, corners_of_part);
      piece.both = material.double_sided && !traits[t].sealed[1];
      pieces.push_back(piece);
    }
  }
  return pieces;
}

}  // namespace sunlit::light
