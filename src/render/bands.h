/// The rows of a picture that see at one moment, where its camera moves.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <tuple>
#include <vector>

#include "render/lens_canvas.h"
#include "render/view.h"
#include "sunlit/render/renderer.h"

namespace sunlit::render {

/// What a camera sees by, wherever it stands.
struct Optics {
  View view;                               ///< without a pose
  std::shared_ptr<const LensCanvas> lens;  ///< null: a pinhole
};
/// Of `options`, by another camera of the same lens.
Optics opticsOf(const RenderOptions& options, const image::PinholeCamera& camera);

struct Band {
  int first_row, rows;
  Optics optics;

  /// After the first row of the picture.
  double middle_s(double line_delay_s) const { return (first_row + 0.5 * (rows - 1)) * line_delay_s; }
};

/// How a picture is divided.
struct Division {
  int bands;
  int samples;  ///< per pixel and axis
  int pattern;  ///< that shifts them, see shifted()

  bool operator<(const Division& other) const {
    return std::tie(bands, samples, pattern) < std::tie(other.bands, other.samples, other.pattern);
  }
};

/// Made when first asked for. Before a lens each division takes tens of megabytes: those of the number of
/// bands that was asked for last and of the one before it stay, between which a camera that changes its speed
/// goes to and fro.
class Bands {
 public:
  explicit Bands(const RenderOptions& options) : options_(options) {}

  /// From the first row to the last, as high as each other but for a row. Until the next call.
  const std::vector<Band>& of(const Division& division);

 private:
  std::vector<Band> made(const Division& division) const;

  RenderOptions options_;
  std::map<Division, std::vector<Band>> kept_;
  std::array<int, 2> kept_numbers_ = {0, 0};
};

}  // namespace sunlit::render
