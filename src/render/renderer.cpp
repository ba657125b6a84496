#include "sunlit/render/renderer.h"

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

#include "render/lens_canvas.h"
#include "render/rasterizer.h"
#include "render/resolve.h"
#include "sunlit/light/picture.h"
#include "sunlit/light/transport.h"

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

std::shared_ptr<LensCanvas> lensOf(const RenderOptions& options) {
  if (options.distortion.none()) return nullptr;
  return std::make_shared<LensCanvas>(image::Lens(options.camera, options.distortion), options.supersampling);
}

bool same(const BodyPlaces& a, const BodyPlaces& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const auto& x, const auto& y) { return x.matrix() == y.matrix(); });
}

}  // namespace

class Renderer::Implementation {
 public:
  Implementation(const light::World& world, const RenderOptions& options)
      : options_(options),
        view_(viewOf(options)),
        lens_(lensOf(options)),
        world_(world),
        pyramids_(*world.geometry->scene),
        maps_(*world.geometry->scene,
              world.transport ? static_cast<float>(light::TransportOptions().finest_m) : 0.0f),
        rasterizer_(
            makeRasterizer(options.rasterizer, {world.geometry, pyramids_, options.texture_lod_bias})),
        preparer_(world, options.final_gather) {}

  void look(const Eigen::Isometry3d& map_from_optical, const BodyPlaces& map_from_body) {
    const bool drawn_ahead = !ahead_.samples.empty() &&
                             ahead_.view.map_from_optical.matrix() == map_from_optical.matrix() &&
                             same(ahead_.map_from_body, map_from_body);
    if (!drawn_ahead) draw(map_from_optical, map_from_body, ahead_);
    std::swap(seen_, ahead_);
    ahead_.samples.clear();
  }

  void lookAhead(const Eigen::Isometry3d& map_from_optical, const BodyPlaces& map_from_body) {
    draw(map_from_optical, map_from_body, ahead_);
  }

  image::LinearImage light(const light::Illumination& light) const {
    requireLook();
    return seen_.picture.illuminate(light);
  }

  std::vector<image::LightOutside> lightsOutside(const light::Illumination& light) const {
    requireLook();
    return seen_.picture.lightsOutside(light, static_cast<float>(options_.near_m));
  }

  image::DepthImage depth() const {
    requireLook();
    return resolveDepth(bufferOf(seen_), *seen_.visibility);
  }

  const light::Surfaces& surfaces() const {
    requireLook();
    return seen_.picture.surfaces();
  }

  const RenderOptions& options() const { return options_; }

  std::string rasterizer() const {
    const std::string device = rasterizer_->device();
    return nameOf(options_.rasterizer) + (device.empty() ? "" : ": " + device);
  }

 private:
  /// One pose, drawn.
  struct Pose {
    View view;
    BodyPlaces map_from_body;
    std::shared_ptr<const light::Geometry> bodies;  ///< at these places; null: none
    std::shared_ptr<const light::Visibility> visibility;
    std::vector<Sample> samples;
    light::PreparedPicture picture;
  };

  void place(const BodyPlaces& map_from_body, Pose& seen) const {
    seen.map_from_body = map_from_body;
    if (map_from_body.empty()) {
      seen.bodies = nullptr;
      seen.visibility = world_.visibility;
      return;
    }
    if (!world_.bodies) throw std::invalid_argument("map_from_body is given, but this world has no bodies");
    seen.bodies = world_.bodies->placed(map_from_body);
    seen.visibility = std::make_shared<light::Visibility>(world_.visibility, seen.bodies);
  }

  void draw(const Eigen::Isometry3d& map_from_optical, const BodyPlaces& map_from_body, Pose& seen) {
    if (!map_from_optical.matrix().allFinite()) throw std::invalid_argument("map_from_optical is not finite");
    seen.samples.clear();  // so that nobody takes a pose that failed for one that was drawn
    place(map_from_body, seen);
    seen.view = view_;
    seen.view.lens = lens_;
    seen.view.map_from_optical = map_from_optical;
    try {
      if (lens_)
        lens_->draw(rasterizer_.get(), bufferOf(seen), &seen.samples);
      else
        rasterizer_->draw(seen.view, seen.bodies.get(), &seen.samples);
      resolve(seen);
    } catch (...) {
      seen.samples.clear();
      throw;
    }
  }

  void resolve(Pose& seen) {
    light::Surfaces surfaces = seen.picture.takeSurfaces();
    resolveSurfaces(bufferOf(seen), &surfaces);
    preparer_.prepare({std::move(surfaces), seen.visibility, seen.map_from_body}, &seen.picture);
  }

  Seen bufferOf(const Pose& pose) const {
    return {pose.view,
            *world_.geometry,
            pose.bodies.get(),
            pyramids_,
            maps_,
            static_cast<float>(options_.texture_lod_bias),
            pose.samples,
            pose.visibility->hasVeils() ? pose.visibility.get() : nullptr};
  }

  void requireLook() const {
    if (seen_.samples.empty())
      throw std::logic_error("look() must be called before light(), depth() and surfaces()");
  }

  RenderOptions options_;
  View view_;                         // without a pose
  std::shared_ptr<LensCanvas> lens_;  // null: a pinhole
  light::World world_;
  TexturePyramids pyramids_;  // before the rasterizer, which refers to them
  SurfaceMaps maps_;
  std::unique_ptr<Rasterizer> rasterizer_;
  light::PicturePreparer preparer_;
  Pose seen_;
  Pose ahead_;
};

Renderer::Renderer(const light::World& world, const RenderOptions& options)
    : implementation_(std::make_unique<Implementation>(world, options)) {}
Renderer::Renderer(std::shared_ptr<const scene::Scene> scene, const RenderOptions& options)
    : Renderer(light::World(std::move(scene)), options) {}
Renderer::~Renderer() = default;

void Renderer::look(const Eigen::Isometry3d& map_from_optical, const BodyPlaces& map_from_body) {
  implementation_->look(map_from_optical, map_from_body);
}
void Renderer::lookAhead(const Eigen::Isometry3d& map_from_optical, const BodyPlaces& map_from_body) {
  implementation_->lookAhead(map_from_optical, map_from_body);
}
image::LinearImage Renderer::light(const light::Illumination& light) const {
  return implementation_->light(light);
}
std::vector<image::LightOutside> Renderer::lightsOutside(const light::Illumination& light) const {
  return implementation_->lightsOutside(light);
}
image::DepthImage Renderer::depth() const {
  return implementation_->depth();
}
const light::Surfaces& Renderer::surfaces() const {
  return implementation_->surfaces();
}
const RenderOptions& Renderer::options() const {
  return implementation_->options();
}
std::string Renderer::rasterizer() const {
  return implementation_->rasterizer();
}

}  // namespace sunlit::render
