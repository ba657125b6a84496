/// The rows of a picture that see at one moment, where its camera moves.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <tuple>
#include <utility>
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

/// The canvases of one lens for all cameras that have it, made when first asked for. They take 12 bytes a
/// sample, and of several samples a pixel 12 a pixel more. Safe from any thread.
class LensCanvases {
 public:
  /// `most_bytes` are kept: those that were asked for first, since what moves asks for all in turn, and would
  /// find none of those that it asked for last.
  explicit LensCanvases(const RenderOptions& options, std::size_t most_bytes = kMostBytes);
  static constexpr std::size_t kMostBytes = std::size_t{1} << 30;

  /// Whether `options` have this lens.
  bool areOf(const RenderOptions& options) const;
  /// Of the whole picture, of so many samples per pixel and axis, shifted() by `pattern`; null of a pinhole.
  std::shared_ptr<const LensCanvas> of(int samples, int pattern);
  /// Whether that one is kept; a pinhole's is.
  bool keep(int samples, int pattern) const;
  std::size_t bytes() const;

 private:
  using Key = std::pair<int, int>;  ///< samples and pattern

  image::PinholeCamera camera_;
  image::Distortion distortion_;
  std::size_t most_bytes_, bytes_ = 0;
  mutable std::mutex mutex_;  ///< of bytes_ and kept_
  std::map<Key, std::shared_ptr<const LensCanvas>> kept_;
};

/// Of the whole picture.
Optics opticsOf(const RenderOptions& options, LensCanvases* canvases);

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

/// Made when first asked for, and kept where their canvas is, to which they add next to nothing.
class Bands {
 public:
  Bands(const RenderOptions& options, std::shared_ptr<LensCanvases> canvases)
      : options_(options), canvases_(std::move(canvases)) {}

  /// From the first row to the last, as high as each other but for a row. Until the next call.
  const std::vector<Band>& of(const Division& division);

 private:
  std::vector<Band> made(const Division& division) const;

  RenderOptions options_;
  std::shared_ptr<LensCanvases> canvases_;
  std::map<Division, std::vector<Band>> kept_;
  std::vector<Band> passing_;  ///< of a canvas that is not kept
};

}  // namespace sunlit::render
