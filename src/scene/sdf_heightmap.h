/// <heightmap> elements, as libsdformat 12 has them, or for 9 in the same words.
#pragma once

#include <sdf/sdf_config.h>
#include <sdf/Geometry.hh>

#include <optional>

#include "scene/sdf_library.h"

#if SDF_MAJOR_VERSION >= 12
#include <sdf/Heightmap.hh>

namespace sunlit::scene {

using SdfHeightmap = sdf::Heightmap;

/// None where it has another shape.
inline std::optional<SdfHeightmap> heightmapOf(const sdf::Geometry& geometry) {
  if (geometry.Type() != sdf::GeometryType::HEIGHTMAP) return std::nullopt;
  return *geometry.HeightmapShape();
}

}  // namespace sunlit::scene

#else
#include <vector>

namespace sunlit::scene {

class SdfHeightmap {
 public:
  struct Texture {
    double size;
    std::string diffuse, normal;
    double Size() const { return size; }
    const std::string& Diffuse() const { return diffuse; }
    const std::string& Normal() const { return normal; }
  };
  struct Blend {
    double min_height, fade_distance;
    double MinHeight() const { return min_height; }
    double FadeDistance() const { return fade_distance; }
  };

  explicit SdfHeightmap(sdf::Element& element);
  const std::string& Uri() const { return uri_; }
  const std::string& FilePath() const { return file_; }
  const ignition::math::Vector3d& Size() const { return size_; }
  const ignition::math::Vector3d& Position() const { return position_; }
  unsigned Sampling() const { return sampling_; }
  std::uint64_t TextureCount() const { return textures_.size(); }
  const Texture* TextureByIndex(std::uint64_t i) const { return &textures_.at(i); }
  std::uint64_t BlendCount() const { return blends_.size(); }
  const Blend* BlendByIndex(std::uint64_t i) const { return &blends_.at(i); }

 private:
  std::string uri_, file_;
  ignition::math::Vector3d size_, position_;
  unsigned sampling_;
  std::vector<Texture> textures_;
  std::vector<Blend> blends_;
};

inline SdfHeightmap::SdfHeightmap(sdf::Element& element)
    : uri_(element.Get<std::string>("uri", "").first),
      file_(element.FilePath()),
      size_(element.Get<ignition::math::Vector3d>("size", ignition::math::Vector3d::One).first),
      position_(element.Get<ignition::math::Vector3d>("pos", ignition::math::Vector3d::Zero).first),
      sampling_(element.HasElement("sampling") ? element.Get<unsigned>("sampling") : 1) {
  for (sdf::ElementPtr one = firstIn(element, "texture"); one; one = one->GetNextElement("texture"))
    textures_.push_back({one->Get<double>("size", 10.0).first, one->Get<std::string>("diffuse", "").first,
                         one->Get<std::string>("normal", "").first});
  for (sdf::ElementPtr one = firstIn(element, "blend"); one; one = one->GetNextElement("blend"))
    blends_.push_back({one->Get<double>("min_height", 0.0).first, one->Get<double>("fade_dist", 0.0).first});
}

inline std::optional<SdfHeightmap> heightmapOf(const sdf::Geometry& geometry) {
  const sdf::ElementPtr shape = geometry.Element() ? firstIn(*geometry.Element(), "heightmap") : nullptr;
  if (!shape) return std::nullopt;
  return SdfHeightmap(*shape);
}

}  // namespace sunlit::scene

#endif
