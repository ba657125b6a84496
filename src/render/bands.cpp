#include "render/bands.h"

#include "render/image_motion.h"

namespace sunlit::render {
namespace {

bool same(const image::PinholeCamera& a, const image::PinholeCamera& b) {
  const auto numbers = [](const image::PinholeCamera& camera) {
    return std::tie(camera.width, camera.height, camera.fx, camera.fy, camera.cx, camera.cy);
  };
  return numbers(a) == numbers(b);
}

Optics opticsOf(const RenderOptions& options, std::shared_ptr<const LensCanvas> lens) {
  Optics optics;
  optics.view.camera = options.camera;
  optics.view.supersampling = options.supersampling;
  optics.view.near_m = options.near_m;
  optics.view.far_m = options.far_m;
  optics.view.lens = lens;
  optics.lens = std::move(lens);
  return optics;
}

}  // namespace

LensCanvases::LensCanvases(const RenderOptions& options, std::size_t most_bytes)
    : camera_(options.camera), distortion_(options.distortion), most_bytes_(most_bytes) {}

bool LensCanvases::areOf(const RenderOptions& options) const {
  return same(camera_, options.camera) && distortion_.model == options.distortion.model &&
         distortion_.coefficients == options.distortion.coefficients;
}

std::shared_ptr<const LensCanvas> LensCanvases::of(int samples, int pattern) {
  if (distortion_.none()) return nullptr;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto known = kept_.find({samples, pattern});
    if (known != kept_.end()) return known->second;
  }
  // Not within the lock: whoever waits for parallel work may be given other work, and that may ask as well.
  const auto made =
      std::make_shared<const LensCanvas>(image::Lens(shifted(camera_, pattern), distortion_), samples);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (bytes_ + made->bytes() > most_bytes_) return made;
  const auto [kept, is_new] = kept_.emplace(Key(samples, pattern), made);
  if (is_new) bytes_ += made->bytes();
  return kept->second;
}

bool LensCanvases::keep(int samples, int pattern) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return distortion_.none() || kept_.count({samples, pattern}) > 0;
}

std::size_t LensCanvases::bytes() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return bytes_;
}

Optics opticsOf(const RenderOptions& options, LensCanvases* canvases) {
  return opticsOf(options, canvases->of(options.supersampling, 0));
}

const std::vector<Band>& Bands::of(const Division& division) {
  passing_.clear();  // before another one is made
  const auto known = kept_.find(division);
  if (known != kept_.end()) return known->second;
  passing_ = made(division);
  if (!canvases_->keep(division.samples, division.pattern)) return passing_;
  return kept_[division] = std::move(passing_);
}

std::vector<Band> Bands::made(const Division& division) const {
  std::vector<Band> bands;
  RenderOptions options = options_;
  options.supersampling = division.samples;
  const image::PinholeCamera whole = shifted(options.camera, division.pattern);
  const std::shared_ptr<const LensCanvas> canvas = canvases_->of(division.samples, division.pattern);
  for (int i = 0; i < division.bands; ++i) {
    const int first = i * whole.height / division.bands,
              rows = (i + 1) * whole.height / division.bands - first;
    options.camera = rowsOf(whole, first, rows);
    std::shared_ptr<const LensCanvas> lens = canvas;
    if (canvas && division.bands > 1)
      lens =
          std::make_shared<const LensCanvas>(*canvas, image::Lens(options.camera, options.distortion), first);
    bands.push_back({first, rows, opticsOf(options, std::move(lens))});
  }
  return bands;
}

}  // namespace sunlit::render
