/// What is made of the frames of a time-lapse: words in them, a film, a sheet.
#pragma once

#include <functional>
#include <string>

#include "sunlit/image/images.h"

namespace sunlit::tools {

/// Writes `text` (ASCII) into the lower left corner, white with a dark rim, `share` of the picture
/// high.
void writeInto(const std::string& text, double share, image::Rgb8Image* picture);

/// The frames of a time-lapse, by number.
struct Frames {
  int count = 0;  ///< > 0
  std::function<image::Rgb8Image(int)> read;
};

/// Throws std::invalid_argument unless the name ends with a kind of film that writeVideo() knows.
void requireVideoName(const std::string& path);

/// The whole film, or what was there before. Throws std::runtime_error naming `path` where it cannot be
/// written.
void writeVideo(const std::string& path, double frame_rate, const Frames& frames);

/// All frames in rows of `columns`, each scaled to `width_px`, as a PNG.
void writeContactSheet(const std::string& path, int columns, int width_px, const Frames& frames);

}  // namespace sunlit::tools
