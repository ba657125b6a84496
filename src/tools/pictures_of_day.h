/// What is made of the frames of a time-lapse: words in them, a film, a sheet.
#pragma once

#include <cstdint>
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

/// The whole film, or what was there before: it is read back before it gets its name. Throws
/// std::runtime_error naming `path` where it cannot be written, or not whole.
void writeVideo(const std::string& path, double frame_rate, const Frames& frames);

/// How frames stand on a sheet: in rows, each scaled to one width.
struct SheetLayout {
  int columns = 6;
  int width_px = 320;  ///< of each frame
};

struct PictureSize {
  std::int64_t width = 0, height = 0;  ///< px
};

/// Longest side of a sheet, px: beyond it few programs show a picture, and it would take more than 800 MB.
constexpr int kLongestSheetSide = 16384;

/// Of a sheet of so many frames of this shape. May be beyond kLongestSheetSide.
PictureSize sheetSize(const SheetLayout& layout, int frames, double height_over_width);

/// All frames as one PNG, whose sides must be at most kLongestSheetSide.
void writeContactSheet(const std::string& path, const SheetLayout& layout, const Frames& frames);

}  // namespace sunlit::tools
