#include "sunlit/render/renderer.h"

#include <algorithm>
#include <deque>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "render/bands.h"
#include "render/image_motion.h"
#include "render/lens_canvas.h"
#include "render/rasterizer.h"
#include "render/resolve.h"
#include "render/weather_surfaces.h"
#include "sunlit/light/picture.h"
#include "sunlit/light/transport.h"

namespace sunlit::render {
namespace {

const RenderOptions& checked(const RenderOptions& options) {
  validate(options);
  return options;
}

/// Adds `part` to the rows of `whole` from `first` on.
void addRows(const image::LinearImage& part, int first, float weight, image::LinearImage* whole) {
  float* const to = whole->at(0, first);
  for (std::size_t i = 0; i < part.data.size(); ++i) to[i] += weight * part.data[i];
}

/// What becomes of a world's textures, for all its cameras.
struct ReadyTextures {
  explicit ReadyTextures(const light::World& world)
      : pyramids(*world.geometry->scene),
        maps(*world.geometry->scene, world.transport ? static_cast<float>(light::finestOf(
                                                           world.transport->options(), *world.geometry))
                                                     : 0.0f) {
    scene::letGoOfTexels(*world.geometry->scene);
  }

  TexturePyramids pyramids;
  SurfaceMaps maps;
};

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
      : Implementation(states, checked(options),
                       {std::make_shared<const ReadyTextures>(firstOf(states)),
                        std::make_shared<LensCanvases>(options), nullptr}) {}
  Implementation(const Implementation& beside, const RenderOptions& options, States states)
      : Implementation(
            beside.worlds(states), checked(options),
            {beside.textures_,
             beside.canvases_->areOf(options) ? beside.canvases_ : std::make_shared<LensCanvases>(options),
             &beside.states_.front().preparer}) {}

  void look(const Eigen::Isometry3d& map_from_optical, const BodyPlaces& map_from_body) {
    const bool drawn_ahead = !ahead_.samples.empty() &&
                             ahead_.view.map_from_optical.matrix() == map_from_optical.matrix() &&
                             same(ahead_.map_from_body, map_from_body);
    if (drawn_ahead) {
      std::swap(seen_, ahead_);
      ahead_.samples.clear();
    } else {
      // In the place of the last one, so that whoever never looks ahead keeps one pose in memory, not two.
      drawWhole(map_from_optical, map_from_body, seen_);
    }
  }

  void lookAhead(const Eigen::Isometry3d& map_from_optical, const BodyPlaces& map_from_body) {
    drawWhole(map_from_optical, map_from_body, ahead_);
  }

  image::LinearImage light(const light::Illumination& light, std::size_t state) const {
    requireLook();
    return seen_.pictures.at(state).illuminate(light);
  }

  image::LinearImage light(const light::Illumination& light, std::size_t state, const UnderWay& way) {
    requireLook();
    const double speed_px_s = speedOf(way);
    const int height = options_.camera.height;
    const int exposures = exposuresOf(speed_px_s * way.exposure_s, way.exposures);
    const int bands = bandCount(speed_px_s * way.line_delay_s * height, height);
    if (exposures == 1 && bands == 1) return this->light(light, state);
    const std::lock_guard<std::mutex> lock(drawing_);
    image::LinearImage mean(options_.camera.width, height);
    // Many exposures find by themselves what lies within a pixel, if each looks at another place in it.
    const bool many = exposures >= options_.supersampling * options_.supersampling;
    for (int i = 0; i < exposures; ++i) {
      const double moment_s = ((i + 0.5) / exposures - 0.5) * way.exposure_s;
      const Division division{bands, many ? 1 : options_.supersampling, many ? patternOf(i, exposures) : 0};
      for (const Band& band : bands_.of(division)) {
        drawMoved(band.optics, way.motion, moment_s + band.middle_s(way.line_delay_s), state);
        addRows(moved_.pictures.at(state).illuminate(light), band.first_row,
                1.0f / static_cast<float>(exposures), &mean);
      }
    }
    return mean;
  }

  int exposures(const UnderWay& way) const {
    requireLook();
    return exposuresOf(speedOf(way) * way.exposure_s, way.exposures);
  }

  std::vector<image::LightOutside> lightsOutside(const light::Illumination& light) const {
    requireLook();
    return seen_.pictures.front().lightsOutside(light, static_cast<float>(options_.near_m));
  }

  image::DepthImage depth() const {
    requireLook();
    {
      const std::lock_guard<std::mutex> lock(depth_);
      if (seen_.depth) return *seen_.depth;
    }
    // Not within the lock: whoever waits for parallel work may be given other work, and that may ask as well.
    image::DepthImage depth = resolveDepth(bufferOf(seen_), *seen_.visibility);
    const std::lock_guard<std::mutex> lock(depth_);
    seen_.depth = depth;
    return depth;
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
  /// With cameras beside it.
  struct Shared {
    std::shared_ptr<const ReadyTextures> textures;
    std::shared_ptr<LensCanvases> canvases;  ///< of the same lens
    const light::PicturePreparer* preparer;  ///< of the same world; null: there is none
  };
  Implementation(const std::vector<light::World>& states, const RenderOptions& options, const Shared& shared)
      : options_(options),
        canvases_(shared.canvases),
        optics_(opticsOf(options, canvases_.get())),
        world_(states.front()),
        textures_(shared.textures),
        rasterizer_(makeRasterizer(options.rasterizer,
                                   {world_.geometry, textures_->pyramids, options.texture_lod_bias})),
        bands_(options, canvases_) {
    const light::PicturePreparer* beside = shared.preparer;
    for (const light::World& state : states)
      beside = &states_.emplace_back(state, options.final_gather, beside).preparer;
  }

  std::vector<light::World> worlds(States states) const {
    if (states == States::kFirst) return {world_};
    std::vector<light::World> worlds;
    for (const State& state : states_) worlds.push_back(state.world);
    return worlds;
  }

  /// One pose, drawn.
  struct Pose {
    View view;
    BodyPlaces map_from_body;
    std::shared_ptr<const light::Geometry> bodies;  ///< at these places; null: none
    std::shared_ptr<const light::Visibility> visibility;
    std::vector<Sample> samples;
    std::vector<light::PreparedPicture> pictures;    ///< one a state
    mutable std::optional<image::DepthImage> depth;  ///< once it was asked for
  };
  /// A state of the surfaces.
  struct State {
    State(const light::World& world_in_it, int final_gather, const light::PicturePreparer* beside)
        : world(world_in_it), preparer(world, final_gather, beside) {}
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

  /// From where, by what, and where all stands.
  struct Stand {
    const Optics& optics;
    const Eigen::Isometry3d& map_from_optical;
    const BodyPlaces& map_from_body;
  };

  /// Prepares pictures of all states, or of `only` one. Of drawing_.
  void draw(const Stand& from, std::optional<std::size_t> only, Pose& seen) {
    if (!from.map_from_optical.matrix().allFinite())
      throw std::invalid_argument("map_from_optical is not finite");
    seen.samples.clear();  // so that nobody takes a pose that failed for one that was drawn
    seen.depth.reset();
    place(from.map_from_body, seen);
    seen.view = from.optics.view;
    seen.view.map_from_optical = from.map_from_optical;
    try {
      if (from.optics.lens)
        from.optics.lens->draw(rasterizer_.get(), bufferOf(seen), &drawn_faces_, &seen.samples);
      else
        rasterizer_->draw(seen.view, seen.bodies.get(), &seen.samples);
      resolve(only, seen);
    } catch (...) {
      seen.samples.clear();
      throw;
    }
  }

  /// All rows at once, in every state.
  void drawWhole(const Eigen::Isometry3d& map_from_optical, const BodyPlaces& map_from_body, Pose& seen) {
    const std::lock_guard<std::mutex> lock(drawing_);
    draw({optics_, map_from_optical, map_from_body}, std::nullopt, seen);
  }

  /// What look() looks at, from where it is seen `seconds` later.
  void drawMoved(const Optics& optics, const Motion& motion, double seconds, std::size_t state) {
    const Eigen::Isometry3d moved = motion.after(seconds, seen_.view.eye());
    BodyPlaces bodies = seen_.map_from_body;
    for (Eigen::Isometry3d& map_from_body : bodies) map_from_body = moved * map_from_body;
    draw({optics, moved * seen_.view.map_from_optical, bodies}, state, moved_);
  }

  /// Of what look() looks at over the picture, px/s.
  double speedOf(const UnderWay& way) const {
    if (way.none()) return 0.0;
    const Eigen::Matrix3d optical_from_map = seen_.view.map_from_optical.linear().transpose();
    return imageMotion_px_s(
        depth(), image::Lens(options_.camera, options_.distortion),
        {optical_from_map * way.motion.velocity_m_s, optical_from_map * way.motion.turning_rad_s});
  }

  void resolve(std::optional<std::size_t> only, Pose& seen) {
    seen.pictures.resize(states_.size());
    const std::size_t begin = only ? *only : 0, end = only ? *only + 1 : states_.size();
    light::Surfaces dry = seen.pictures.at(end - 1).takeSurfaces();
    resolveSurfaces(bufferOf(seen), &dry);
    for (std::size_t i = begin; i < end; ++i) {
      const light::World& world = states_[i].world;
      light::Surfaces surfaces = i + 1 < end ? dry : std::move(dry);
      weatherSurfaces(*world.geometry, &surfaces);
      states_[i].preparer.prepare(
          {std::move(surfaces), i == 0 ? seen.visibility : visibilityOf(world, seen), seen.map_from_body},
          &seen.pictures[i]);
    }
  }

  Seen bufferOf(const Pose& pose) const {
    return {pose.view,         *world_.geometry,
            pose.bodies.get(), textures_->pyramids,
            textures_->maps,   static_cast<float>(options_.texture_lod_bias),
            pose.samples,      pose.visibility->hasVeils() ? pose.visibility.get() : nullptr};
  }

  void requireLook() const {
    if (seen_.samples.empty())
      throw std::logic_error("look() must be called before light(), depth() and surfaces()");
  }

  RenderOptions options_;
  std::shared_ptr<LensCanvases> canvases_;
  Optics optics_;
  light::World world_;                             // in the first of its states
  std::shared_ptr<const ReadyTextures> textures_;  // before the rasterizer, which refers to them
  std::unique_ptr<Rasterizer> rasterizer_;
  std::deque<State> states_;  // which stay where they are
  Pose seen_;
  mutable std::mutex depth_;  // of seen_
  std::mutex drawing_;        // of all below, and of rasterizer_, lenses and preparers
  Pose ahead_;
  Pose moved_;  // a part of what a moving camera sees
  Bands bands_;
  LensCanvas::Drawn drawn_faces_;
};

Renderer::Renderer(const light::World& world, const RenderOptions& options)
    : Renderer(std::vector<light::World>{world}, options) {}
Renderer::Renderer(const std::vector<light::World>& states, const RenderOptions& options)
    : implementation_(std::make_unique<Implementation>(states, options)) {}
Renderer::Renderer(std::shared_ptr<const scene::Scene> scene, const RenderOptions& options)
    : Renderer(light::World(std::move(scene)), options) {}
Renderer::Renderer(const Renderer& beside, const RenderOptions& options, States states)
    : implementation_(std::make_unique<Implementation>(*beside.implementation_, options, states)) {}
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
image::LinearImage Renderer::light(const light::Illumination& light, std::size_t state, const UnderWay& way) {
  return implementation_->light(light, state, way);
}
int Renderer::exposures(const UnderWay& way) const {
  return implementation_->exposures(way);
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
