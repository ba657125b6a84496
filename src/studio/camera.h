/// One camera of a studio: what draws for it, and what makes pictures of the light.
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "sunlit/scene/shelter.h"
#include "sunlit/studio/studio.h"

namespace sunlit::studio {

/// Light, and what is taken by it.
struct Lit {
  const light::Illumination& light;
  const image::PictureName& name;
  const Setting& setting;
};

class Camera {
 public:
  /// Before the world is there. Throws std::invalid_argument for a lens or a chain that cannot be.
  Camera(const render::RenderOptions& render, const std::vector<ChainOptions>& chains);

  void enter(const std::vector<light::World>& worlds);
  /// Where `other` is.
  void enterBeside(const Camera& other);
  /// What draws the world in its first state otherwise.
  std::unique_ptr<render::Renderer> renderer(const render::RenderOptions& render) const;
  void look(const Eigen::Isometry3d& map_from_optical, const render::BodyPlaces& map_from_links,
            const Motion& motion);
  void lookAhead(const Eigen::Isometry3d& map_from_optical, const render::BodyPlaces& map_from_links);

  /// Exposed with `ev100`, or else as it meters and the setting has it.
  Developed photograph(const Lit& lit, std::optional<double> ev100, Stopwatch* stopwatch) const;
  double meter(const Lit& lit, Stopwatch* stopwatch) const;
  /// In `map`.
  Eigen::Vector3d eye() const { return map_from_optical_.translation(); }
  image::DepthImage depth() const { return renderer_->depth(); }
  /// In the first state of the world, as depth() has it.
  bool seesAnything() const;
  std::string rasterizer() const { return renderer_->rasterizer(); }

 private:
  /// What lens, shutter and sensor make of the light, made ready.
  struct Chain {
    Chain(const image::Lens& lens, const ChainOptions& options);
    ChainOptions options;
    image::Vignetting vignetting;
    image::VeilingGlare glare;
  };
  const Chain& chainOf(const Lit& lit) const { return chains_.at(lit.setting.chain); }
  render::UnderWay wayOf(const Chain& chain, double exposure_s) const;
  /// What comes to the lens while light smears for `exposure_s`; then what of it reaches the sensor.
  image::LinearImage beforeLens(const Lit& lit, double exposure_s, Stopwatch* stopwatch) const;
  image::LinearImage throughLens(const Lit& lit, image::LinearImage luminance, Stopwatch* stopwatch) const;
  double metered(const Lit& lit, const image::LinearImage& on_sensor, Stopwatch* stopwatch) const;
  void addRain(const Lit& lit, double ev100, image::LinearImage* luminance) const;

  render::RenderOptions render_;
  image::Lens lens_;
  std::vector<Chain> chains_;
  std::unique_ptr<render::Renderer> renderer_;  ///< once the world is there, as the next
  std::shared_ptr<const light::Geometry> geometry_;
  mutable std::once_flag rained_;
  mutable std::unique_ptr<const scene::Shelter> shelter_;  ///< once it has
  Eigen::Isometry3d map_from_optical_ = Eigen::Isometry3d::Identity();
  Motion motion_;
};

}  // namespace sunlit::studio
