/// Fractal detail on the surfaces of one tile.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "render/detail.h"
#include "render/view.h"
#include "sunlit/light/surfaces.h"

namespace sunlit::render {

/// What all tiles of a view share.
struct SceneDetail {
  SceneDetail(const scene::Scene& scene, const View& view);
  bool has(std::int32_t material) const { return octaves[static_cast<std::size_t>(material)].has_value(); }

  std::vector<std::optional<DetailOctaves>> octaves;  ///< by material; empty for one without detail
  std::vector<Eigen::Array3f> tints;                  ///< by material
  Eigen::Vector3f sample_right,
      sample_down;  ///< from one sample to the next at depth 1 m, as View::pixelRight()
};

/// Collects the surfaces that have detail, and evaluates it for many of one material together.
class TileDetail {
 public:
  struct Entry {
    std::uint32_t surface;  ///< index into Tile::surfaces
    std::int32_t material;
    float footprint, spread;  ///< see DetailPoints
    Eigen::Vector3f middle;   ///< of its samples, from the camera
  };
  void add(const Entry& entry);

  /// Gives detail to the albedo of the surfaces added. Forgets them.
  void apply(const SceneDetail& scene, std::vector<light::Surface>* surfaces);

 private:
  std::vector<std::vector<Entry>> entries_;  ///< by material
};

}  // namespace sunlit::render
