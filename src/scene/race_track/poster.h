/// Painted advertisements and signs, no two alike.
#pragma once

#include <string>

#include "scene/race_track/canvas.h"

namespace sunlit::scene::race_track {

struct PosterSize {
  int width_px;
  int height_px;
};

/// An advertisement. Its words, shapes and colours follow from the seed.
Canvas paintPoster(const PosterSize& size, std::uint32_t seed);
/// A board with large letters, `ink` on `ground`.
struct SignStyle {
  Color ground;
  Color ink;
  std::uint32_t seed;
};
Canvas paintSign(const PosterSize& size, const std::string& letters, const SignStyle& style);
/// Arrow heads that point along the picture, to the left if asked.
Canvas paintChevrons(const PosterSize& size, bool to_left, std::uint32_t seed);
/// A saturated colour of paint.
Color paintColor(Random& random);

}  // namespace sunlit::scene::race_track
