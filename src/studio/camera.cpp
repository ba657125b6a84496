#include "studio/camera.h"

#include <algorithm>
#include <utility>

#include "sunlit/image/rain_streaks.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::studio {

namespace {

/// As far as it does not hang on the exposure, s; how long light smears depends on that, and hardly the other
/// way round.
double knownSmear_s(const image::ShutterOptions& shutter) {
  return 1e-3 * shutter.exposure_ms.value_or(0.0);
}

bool isFixed(const ChainOptions& chain) {
  return chain.exposure.mode == image::ExposureMode::kFixed;
}

/// EV100 that a picture is exposed with which metered so much.
double exposedBy(const Setting& setting, double metered_ev100) {
  return setting.adapted ? setting.adapted(metered_ev100) : metered_ev100;
}

}  // namespace

Camera::Chain::Chain(const image::Lens& lens, const ChainOptions& chain)
    : options(chain), vignetting(lens, chain.vignetting), glare(vignetting, chain.glare) {}

Camera::Camera(const render::RenderOptions& render, const std::vector<ChainOptions>& chains)
    : render_(render), lens_(render.camera, render.distortion) {
  for (const ChainOptions& chain : chains) chains_.emplace_back(lens_, chain);
}

void Camera::enter(const std::vector<light::World>& worlds) {
  renderer_ = std::make_unique<render::Renderer>(worlds, render_);
  geometry_ = worlds.front().geometry;
}

void Camera::enterBeside(const Camera& other) {
  renderer_ = std::make_unique<render::Renderer>(*other.renderer_, render_, render::Renderer::States::kAll);
  geometry_ = other.geometry_;
}

std::unique_ptr<render::Renderer> Camera::renderer(const render::RenderOptions& render) const {
  return std::make_unique<render::Renderer>(*renderer_, render, render::Renderer::States::kFirst);
}

void Camera::look(const Eigen::Isometry3d& map_from_optical, const render::BodyPlaces& map_from_links,
                  const Motion& motion) {
  renderer_->look(map_from_optical, map_from_links);
  map_from_optical_ = map_from_optical;
  motion_ = motion;
}

void Camera::lookAhead(const Eigen::Isometry3d& map_from_optical, const render::BodyPlaces& map_from_links) {
  renderer_->lookAhead(map_from_optical, map_from_links);
}

render::UnderWay Camera::wayOf(const Chain& chain, double exposure_s) const {
  const image::ShutterOptions& shutter = chain.options.shutter;
  return {motion_, 1e-6 * shutter.line_delay_us, exposure_s, shutter.exposures};
}

image::LinearImage Camera::beforeLens(const Lit& lit, double exposure_s, Stopwatch* stopwatch) const {
  const render::UnderWay way = wayOf(chainOf(lit), exposure_s);
  return stopwatch->measure("light", lit.name.series,
                            [&] { return renderer_->light(lit.light, lit.setting.state, way); });
}

image::LinearImage Camera::throughLens(const Lit& lit, image::LinearImage luminance,
                                       Stopwatch* stopwatch) const {
  stopwatch->measure("develop", lit.name.series, [&] {
    const Chain& chain = chainOf(lit);
    if (!chain.vignetting.none()) chain.vignetting.apply(&luminance);
    if (!chain.glare.none()) chain.glare.apply(renderer_->lightsOutside(lit.light), &luminance);
    image::blur(chain.options.blur, &luminance);
  });
  return luminance;
}

double Camera::metered(const Lit& lit, const image::LinearImage& on_sensor, Stopwatch* stopwatch) const {
  return stopwatch->measure("develop", lit.name.series,
                            [&] { return image::chooseEv100(on_sensor, chainOf(lit).options.exposure); });
}

/// The drops that fall before a camera meanwhile.
void Camera::addRain(const Lit& lit, double ev100, image::LinearImage* luminance) const {
  const sky::Daylight& day = lit.light.day;
  const sky::Rain rain = day.rain();
  std::call_once(rained_, [this] {
    shelter_ = std::make_unique<const scene::Shelter>(*geometry_->shape, geometry_->scene->materials);
  });
  const image::RainStreaks streaks{rain.mm_per_h,
                                   rain.seed,
                                   lit.name.index,
                                   image::streakTime_s(chainOf(lit).options.shutter, ev100),
                                   image::dropLuminance(*luminance, day.groundIlluminance().value),
                                   rain.wind_m_s,
                                   lit.name.drive};
  image::addRain(streaks,
                 {lens_, map_from_optical_, motion_, renderer_->depth(),
                  [this](const Eigen::Vector3d& place) { return shelter_->open(place); }},
                 luminance);
}

double Camera::meter(const Lit& lit, Stopwatch* stopwatch) const {
  const ChainOptions& chain = chainOf(lit).options;
  if (isFixed(chain)) return chain.exposure.ev100;
  const double smear_s = knownSmear_s(chain.shutter);
  return metered(lit, throughLens(lit, beforeLens(lit, smear_s, stopwatch), stopwatch), stopwatch);
}

Developed Camera::photograph(const Lit& lit, std::optional<double> ev100, Stopwatch* stopwatch) const {
  const ChainOptions& chain = chainOf(lit).options;
  if (!ev100 && isFixed(chain)) ev100 = exposedBy(lit.setting, chain.exposure.ev100);
  const double known_s = ev100 ? image::smearTime_s(chain.shutter, *ev100) : knownSmear_s(chain.shutter);
  image::LinearImage before = beforeLens(lit, known_s, stopwatch);
  const bool rains = lit.light.day.rain().mm_per_h > 0.0;
  const bool may_smear = !motion_.none() && !chain.shutter.exposure_ms;
  image::LinearImage luminance;
  double exposed = ev100.value_or(0.0);
  bool is_due = true;  // `before`, to pass the lens
  if (!ev100) {
    is_due = rains;
    luminance = throughLens(lit, rains || may_smear ? before : std::move(before), stopwatch);
    exposed = exposedBy(lit.setting, metered(lit, luminance, stopwatch));
    // How long the shutter is open is known only now, and with it what smears and how far drops fall.
    const double smear_s = image::smearTime_s(chain.shutter, exposed);
    if (may_smear && smear_s != known_s && renderer_->exposures(wayOf(chainOf(lit), smear_s)) > 1) {
      before = beforeLens(lit, smear_s, stopwatch);
      is_due = true;
    }
  }
  if (rains) stopwatch->measure("develop", lit.name.series, [&] { addRain(lit, exposed, &before); });
  if (is_due) luminance = throughLens(lit, std::move(before), stopwatch);
  return stopwatch->measure("develop", lit.name.series, [&] {
    if (chain.noise.enabled) image::addSensorNoise(exposed, chain.noise, lit.name, &luminance);
    return Developed{image::throughMosaic(image::develop(luminance, exposed), chain.mosaic), exposed};
  });
}

bool Camera::seesAnything() const {
  const std::vector<light::Tile>& tiles = renderer_->surfaces().tiles;
  return std::any_of(tiles.begin(), tiles.end(),
                     [](const light::Tile& tile) { return !tile.surfaces.empty(); });
}

}  // namespace sunlit::studio
