#include "sunlit/render/renderer.h"

#include <stdexcept>
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
  Implementation(std::shared_ptr<const scene::Scene> scene, const RenderOptions& options)
      : options_(options),
        view_(viewOf(options)),
        geometry_(std::make_shared<light::Geometry>(std::move(scene))),
        visibility_(geometry_),
        pass_(geometry_, view_, options.texture_lod_bias) {}
  ~Implementation() { context_.makeCurrent(); }

  void look(const Eigen::Isometry3d& map_from_optical) {
    if (!map_from_optical.matrix().allFinite()) throw std::invalid_argument("map_from_optical is not finite");
    context_.makeCurrent();
    view_.map_from_optical = map_from_optical;
    pass_.draw(view_, &samples_);
    resolveSurfaces({view_, *geometry_, samples_}, &surfaces_);
  }

  image::LinearImage light(const sky::Daylight& day) const {
    requireLook();
    return light::illuminate(surfaces_, *geometry_->scene, visibility_, day);
  }

  image::DepthImage depth() const {
    requireLook();
    return resolveDepth({view_, *geometry_, samples_}, visibility_);
  }

  const RenderOptions& options() const { return options_; }

 private:
  void requireLook() const {
    if (samples_.empty()) throw std::logic_error("look() must be called before light() and depth()");
  }

  RenderOptions options_;
  View view_;
  std::shared_ptr<const light::Geometry> geometry_;
  light::Visibility visibility_;
  GlContext context_;  // before what lives in it
  GeometryPass pass_;
  std::vector<PackedSample> samples_;
  light::Surfaces surfaces_;
};

Renderer::Renderer(std::shared_ptr<const scene::Scene> scene, const RenderOptions& options)
    : implementation_(std::make_unique<Implementation>(std::move(scene), options)) {}
Renderer::~Renderer() = default;

void Renderer::look(const Eigen::Isometry3d& map_from_optical) {
  implementation_->look(map_from_optical);
}
image::LinearImage Renderer::light(const sky::Daylight& day) const {
  return implementation_->light(day);
}
image::DepthImage Renderer::depth() const {
  return implementation_->depth();
}
const RenderOptions& Renderer::options() const {
  return implementation_->options();
}

}  // namespace sunlit::render
