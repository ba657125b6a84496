/// Light on its way through sheets of glass, and through what blends evenly.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "light/shading/vertex.h"
#include "sunlit/light/visibility.h"

namespace sunlit::light {

/// Beside Visibility, whose rays glass does not stop, nor what blends evenly where so wished.
class GlassSheets {
 public:
  /// Keeps a reference.
  explicit GlassSheets(const Visibility& visibility);

  bool any() const { return any_; }
  /// Whether there is glass, or anything that blends evenly.
  bool anyVeils() const { return any_ || blends_; }
  /// How many of `samples` rays of a surface are asked for what veils leave: edges of what blends are seen,
  /// while glass hardly darkens.
  std::uint32_t raysOf(std::uint32_t samples) const { return blends_ ? samples : 1; }
  /// Share of the light that gets through along `sight` in all of its sheets, by channel. The ray may go
  /// either way.
  Eigen::Array3f through(const Visibility::Sight& sight) const;
  /// The same with what blends evenly, of rays by Visibility::Blends::kLetPass.
  Eigen::Array3f throughVeils(const Visibility::Sight& sight) const;
  /// The sheets on its way, nearest first.
  void sheets(const Visibility::Sight& sight, std::vector<Hit>* hits) const;
  /// What an eye looks through along `sight`, nearest first: the sheets, and what blends evenly; one-sided
  /// ones from before them alone.
  void layers(const Visibility::Sight& sight, std::vector<Hit>* hits) const;
  /// One of either, met along `direction`.
  Vertex at(const Hit& hit, const Eigen::Vector3f& direction) const { return vertices_.at(hit, direction); }

 private:
  void veils(const Visibility::Sight& sight, std::vector<Hit>* hits) const;

  SceneVertices vertices_;
  const Visibility& visibility_;
  bool any_, blends_;
};

}  // namespace sunlit::light
