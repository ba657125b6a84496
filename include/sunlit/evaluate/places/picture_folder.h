/// A folder of pictures: one drive.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sunlit/evaluate/picture.h"

namespace sunlit::evaluate {

struct PictureFolder {
  std::string folder;
  std::vector<std::string> names;  ///< in their order, see isNamedBefore()
  std::size_t other_files = 0;     ///< that are no pictures by their names: not used
  std::string file(std::size_t i) const { return folder + "/" + names[i]; }
};

/// Letter by letter, but digits that stand together count as one number: frame_9.png comes before
/// frame_10.png. Where that makes no difference (1.png, 01.png), byte by byte.
bool isNamedBefore(const std::string& a, const std::string& b);

/// Pictures are files, not below further folders, whose names end in .png .jpg .jpeg .bmp .tif .tiff .webp
/// .ppm or .pgm, in small or capital letters. Hidden files count for nothing. Throws std::runtime_error
/// "path: what is wrong" for a folder that is not there, cannot be read or holds no picture.
PictureFolder openPictureFolder(const std::string& folder);

/// With pixels of its own; alpha is left out. Throws std::runtime_error "path: what is wrong", also for a
/// file that is cut short.
Picture readPicture(const std::string& file);

}  // namespace sunlit::evaluate
