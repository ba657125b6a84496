#include "sunlit/render/renderer.h"

#include <algorithm>
#include <deque>
#include <stdexcept>
#include <utility>
#include <vector>

#include "render/lens_canvas.h"
#include "render/rasterizer.h"
#include "render/resolve.h"
#include "render/weather_surfaces.h"
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

const light::World& firstOf(const std::vector<light::World>& states) {
  if (states.empty()) throw std::invalid_argument("states is empty, but must hold one world at least");
  return states.front();
}

bool same(const BodyPlaces& a, const BodyPlaces& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const auto& x, const auto& y) { return x.matrix() == y.matrix(); });
}

}  // namespace

class Renderer::Implementation {
 public:
  Implementation(const std::vector<light::World>& states, const RenderOptions& options)
      : options_(options),
        view_(viewOf(options)),
        lens_(lensOf(options)),
        world_(firstOf(states)),
        pyramids_(*world_.geometry->scene),
        maps_(*world_.geometry->scene,
              world_.transport ? static_cast<float>(light::TransportOptions().finest_m) : 0.0f),
        rasterizer_(
            makeRasterizer(options.rasterizer, {world_.geometry, pyramids_, options.texture_lod_bias})) {
    for (const light::World& state : states) states_.emplace_back(state, options.final_gather);
  }

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

  image::LinearImage light(const light::Illumination& light, std::size_t state) const {
    requireLook();
    return seen_.pictures.at(state).illuminate(light);
  }

  std::vector<image::LightOutside> lightsOutside(const light::Illumination& light) const {
    requireLook();
    return seen_.pictures.front().lightsOutside(light, static_cast<float>(options_.near_m));
  }

  image::DepthImage depth() const {
    requireLook();
    return resolveDepth(bufferOf(seen_), *seen_.visibility);
  }

  const light::Surfaces& surfaces(std::size_t state) const {
    requireLook();
    return seen_.pictures.at(state).surfaces();
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
    std::vector<light::PreparedPicture> pictures;  ///< one a state
  };
  /// A state of the surfaces.
  struct State {
    State(const light::World& world_in_it, int final_gather)
        : world(world_in_it), preparer(world, final_gather) {}
    light::World world;
    light::PicturePreparer preparer;
  };

  void place(const BodyPlaces& map_from_body, Pose& seen) const {
    if (!map_from_body.empty() && !world_.bodies)
      throw std::invalid_argument("map_from_body is given, but this world has no bodies");
    seen.map_from_body = map_from_body;
    seen.bodies = map_from_body.empty() ? nullptr : world_.bodies->placed(map_from_body);
    seen.visibility = visibilityOf(world_, seen);
  }
  /// Of a world with what moves at its places in `seen`.
  static std::shared_ptr<const light::Visibility> visibilityOf(const light::World& world, const Pose& seen) {
    if (!seen.bodies) return world.visibility;
    return std::make_shared<light::Visibility>(world.visibility, seen.bodies);
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
    seen.pictures.resize(states_.size());
    light::Surfaces dry = seen.pictures.back().takeSurfaces();
    resolveSurfaces(bufferOf(seen), &dry);
    for (std::size_t i = 0; i < states_.size(); ++i) {
      const light::World& world = states_[i].world;
      light::Surfaces surfaces = i + 1 < states_.size() ? dry : std::move(dry);
      weatherSurfaces(*world.geometry, &surfaces);
      states_[i].preparer.prepare(
          {std::move(surfaces), i == 0 ? seen.visibility : visibilityOf(world, seen), seen.map_from_body},
          &seen.pictures[i]);
    }
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
  light::World world_;                // in the first of its states
  TexturePyramids pyramids_;          // before the rasterizer, which refers to them
  SurfaceMaps maps_;
  std::unique_ptr<Rasterizer> rasterizer_;
  std::deque<State> states_;  // which stay where they are
  Pose seen_;
  Pose ahead_;
};

Renderer::Renderer(const light::World& world, const RenderOptions& options)
    : Renderer(std::vector<light::World>{world}, options) {}
Renderer::Renderer(const std::vector<light::World>& states, const RenderOptions& options)
    : implementation_(std::make_unique<Implementation>(states, options)) {}
Renderer::Renderer(std::shared_ptr<const scene::Scene> scene, const RenderOptions& options)
    : Renderer(light::World(std::move(scene)), options) {}
Renderer::~Renderer() = default;

void Renderer::look(const Eigen::Isometry3d& map_from_optical, const BodyPlaces& map_from_body) {
  implementation_->look(map_from_optical, map_from_body);
}
void Renderer::lookAhead(const Eigen::Isometry3d& map_from_optical, const BodyPlaces& map_from_body) {
  implementation_->lookAhead(map_from_optical, map_from_body);
}
image::LinearImage Renderer::light(const light::Illumination& light, std::size_t state) const {
  return implementation_->light(light, state);
}
std::vector<image::LightOutside> Renderer::lightsOutside(const light::Illumination& light) const {
  return implementation_->lightsOutside(light);
}
image::DepthImage Renderer::depth() const {
  return implementation_->depth();
}
const light::Surfaces& Renderer::surfaces(std::size_t state) const {
  return implementation_->surfaces(state);
}
const RenderOptions& Renderer::options() const {
  return implementation_->options();
}
std::string Renderer::rasterizer() const {
  return implementation_->rasterizer();
}

}  // namespace sunlit::render
