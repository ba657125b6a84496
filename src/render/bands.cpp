#include "render/bands.h"

#include <iterator>

#include "render/image_motion.h"

namespace sunlit::render {

Optics opticsOf(const RenderOptions& options, const image::PinholeCamera& camera) {
  Optics optics;
  optics.view.camera = camera;
  optics.view.supersampling = options.supersampling;
  optics.view.near_m = options.near_m;
  optics.view.far_m = options.far_m;
  if (!options.distortion.none()) {
    optics.lens =
        std::make_shared<LensCanvas>(image::Lens(camera, options.distortion), options.supersampling);
    optics.view.lens = optics.lens;
  }
  return optics;
}

const std::vector<Band>& Bands::of(const Division& division) {
  if (division.bands != kept_numbers_[0]) {
    kept_numbers_ = {division.bands, kept_numbers_[0]};
    for (auto known = kept_.begin(); known != kept_.end();) {
      const int number = known->first.bands;
      const bool stays = number == kept_numbers_[0] || number == kept_numbers_[1];
      known = stays ? std::next(known) : kept_.erase(known);
    }
  }
  std::vector<Band>& bands = kept_[division];
  if (bands.empty()) bands = made(division);
  return bands;
}

std::vector<Band> Bands::made(const Division& division) const {
  std::vector<Band> bands;
  RenderOptions options = options_;
  options.supersampling = division.samples;
  options.camera = shifted(options.camera, division.pattern);
  const int height = options.camera.height;
  for (int i = 0; i < division.bands; ++i) {
    const int first = i * height / division.bands, rows = (i + 1) * height / division.bands - first;
    bands.push_back({first, rows, opticsOf(options, rowsOf(options.camera, first, rows))});
  }
  return bands;
}

}  // namespace sunlit::render
