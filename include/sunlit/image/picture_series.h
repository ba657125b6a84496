/// What is made of pictures that follow one another: words in them, a film, a sheet. In a library of its own,
/// sunlit_picture_series, since what films are written with is large.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "sunlit/image/images.h"

namespace sunlit::image {

/// Pictures of one size, by number from 0: asked for one at a time, in their order, so that only one need be
/// in memory.
struct PictureSeries {
  int count = 0;  ///< > 0
  std::function<Rgb8Image(int)> picture;
};

/// Writes `text` (ASCII) into the lower left corner, white with a dark rim, `share` of the picture
/// high.
void writeInto(const std::string& text, double share, Rgb8Image* picture);

/// Throws std::invalid_argument naming `key` unless the name ends with a kind of film that writeFilm() knows.
void requireFilmName(const std::string& key, const std::string& path);

/// The whole film, or what was there before: it is read back before it gets its name. A side of an odd number
/// of pixels becomes one longer, as most codecs need it. Throws as requireFilmName() does; std::runtime_error
/// naming `path` where it cannot be written, or not whole; and what `series` throws.
void writeFilm(const std::string& path, double frame_rate_hz, const PictureSeries& series);

/// How pictures stand on a sheet: in rows, each scaled to one width.
struct SheetLayout {
  int columns = 6;     ///< > 0
  int width_px = 320;  ///< of each picture, > 0
};

struct PictureSize {
  std::int64_t width = 0, height = 0;  ///< px
};

/// Longest side of a sheet, px: beyond it few programs show a picture, and it would take more than 800 MB.
constexpr int kLongestSheetSide = 16384;

/// Of a sheet of so many pictures of this shape. May be beyond kLongestSheetSide.
PictureSize sheetSize(const SheetLayout& layout, int count, double height_over_width);

/// All pictures as one PNG, whose sides must be at most kLongestSheetSide; the whole file, or what was there
/// before. Throws as writePng() does, and what `series` throws.
void writeContactSheet(const std::string& path, const SheetLayout& layout, const PictureSeries& series);

}  // namespace sunlit::image
