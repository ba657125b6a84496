#include "sunlit/render/renderer.h"

#include <stdexcept>
#include <utility>
#include <vector>

#include "render/geometry_pass.h"
#include "render/gl_context.h"
#include "render/resolve.h"
#include "sunlit/light/lighting.h"

namespace sunlit::render {
namespace {

View viewOf(const RenderOptions& options) {
  validate(options);
  View view;
  view.camera = options.camera;
  view.supersampling = options.supersampling;
  view.near_m = options.near_m;
  view.far_m = options.far_m;
  return view;
}

}  // namespace

class Renderer::Implementation {
 public:
  Implementation(const light::World& world, const RenderOptions& options)
      : options_(options),
        view_(viewOf(options)),
        world_(world),
        pass_(world.geometry, view_, options.texture_lod_bias) {}
  ~Implementation() { context_.makeCurrent(); }

  void look(const Eigen::Isometry3d& map_from_optical) {
    const bool drawn_ahead =
        !ahead_.samples.empty() && ahead_.view.map_from_optical.matrix() == map_from_optical.matrix();
    if (!drawn_ahead) draw(map_from_optical, ahead_);
    std::swap(seen_, ahead_);
    ahead_.samples.clear();
  }

  void lookAhead(const Eigen::Isometry3d& map_from_optical) { draw(map_from_optical, ahead_); }

  image::LinearImage light(const light::Illumination& light) const {
    requireLook();
    return light::illuminate(seen_.surfaces, *world_.geometry->scene, *world_.visibility, light);
  }

  image::DepthImage depth() const {
    requireLook();
    return resolveDepth({seen_.view, *world_.geometry, seen_.samples}, *world_.visibility);
  }

  const RenderOptions& options() const { return options_; }

 private:
  /// One pose, drawn.
  struct Seen {
    View view;
    std::vector<PackedSample> samples;
    light::Surfaces surfaces;
  };

  void draw(const Eigen::Isometry3d& map_from_optical, Seen& seen) {
    if (!map_from_optical.matrix().allFinite()) throw std::invalid_argument("map_from_optical is not finite");
    context_.makeCurrent();
    seen.view = view_;
    seen.view.map_from_optical = map_from_optical;
    pass_.draw(seen.view, &seen.samples);
    resolveSurfaces({seen.view, *world_.geometry, seen.samples}, &seen.surfaces);
  }

  void requireLook() const {
    if (seen_.samples.empty()) throw std::logic_error("look() must be called before light() and depth()");
  }

  RenderOptions options_;
  View view_;  // without a pose
  light::World world_;
  GlContext context_;  // before what lives in it
  GeometryPass pass_;
  Seen seen_;
  Seen ahead_;
};

Renderer::Renderer(const light::World& world, const RenderOptions& options)
    : implementation_(std::make_unique<Implementation>(world, options)) {}
Renderer::Renderer(std::shared_ptr<const scene::Scene> scene, const RenderOptions& options)
    : Renderer(light::World(std::move(scene)), options) {}
Renderer::~Renderer() = default;

void Renderer::look(const Eigen::Isometry3d& map_from_optical) {
  implementation_->look(map_from_optical);
}
void Renderer::lookAhead(const Eigen::Isometry3d& map_from_optical) {
  implementation_->lookAhead(map_from_optical);
}
image::LinearImage Renderer::light(const light::Illumination& light) const {
  return implementation_->light(light);
}
image::DepthImage Renderer::depth() const {
  return implementation_->depth();
}
const RenderOptions& Renderer::options() const {
  return implementation_->options();
}

}  // namespace sunlit::render
