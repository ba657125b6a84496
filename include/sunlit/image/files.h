/// Pictures in files. Every writer leaves either the whole new file or what was there before, even if the
/// process is killed; every failure throws std::runtime_error "path: what failed: why".
#pragma once

#include <stdexcept>
#include <string>

#include "sunlit/image/images.h"

namespace sunlit::image {

/// What the system says of `error`, an errno; of a full disk, quota or limit also what to do.
std::string reasonOf(int error);

/// For a program to begin with. Standard streams that were closed (2>&-) lead nowhere, so that no file or
/// socket of its own gets what is written to them; and a file beyond its limit (ulimit -f) is an error that
/// reasonOf() tells, where the system would end the process without a word (SIGXFSZ).
void prepareProcess();

/// Makes a folder and those above it, where they are not there.
void makeFolder(const std::string& folder);

/// Writes `bytes` beside `path` under another name, makes them durable (fsync), then renames. The folder must
/// exist.
void writeFileAtomically(const std::string& path, const std::string& bytes);

/// A file is there in name alone.
class ContentMissing : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws std::runtime_error where `path` is there, but neither a file nor a folder: whoever reads a pipe or
/// a device may never be done; and ContentMissing where it is a pointer of Git LFS to the file that is meant.
/// For files that other files name.
void requireContent(const std::string& path);

/// All bytes of a file. Throws std::runtime_error with path and reason.
std::string readWholeFile(const std::string& path);

/// Removes what writers of files were killed in the midst of, in `folder` and below. What belongs to a
/// process that still runs stays, also of another container or computer that writes to the same folder, where
/// its file system knows locks (flock) of all of them.
void removeUnfinished(const std::string& folder);
/// The same of the file `path` alone.
void removeUnfinishedOf(const std::string& path);

/// Makes `finished`, a whole file that nobody writes to any more, durable (fsync), gives it the name `path`
/// in the same folder, and makes that name durable too. Where that fails `finished` is still there.
void moveIntoPlace(const std::string& finished, const std::string& path);

/// 8-bit sRGB PNG. The picture must not be empty (std::invalid_argument).
void writePng(const std::string& path, const Rgb8Image& picture);
/// One channel, 8 or 16 bit, likewise.
void writePng(const std::string& path, const Grey8Image& picture);
void writePng(const std::string& path, const Grey16Image& picture);
/// The file in memory, as writePng() would write it.
std::string encodePng(const Rgb8Image& picture);
/// Any PNG of 8 bits a channel; grey becomes three equal channels, alpha is dropped. Deeper ones are an
/// error, since rounding them would lose data silently.
Rgb8Image readPng(const std::string& path);
/// A PNG of one channel of 16 bits and no other.
Grey16Image readGrey16Png(const std::string& path);
/// Any PNG, JPEG, PPM, BMP, TIFF or WebP, as decodeRgba() has it, without alpha; a file that is cut off is an
/// error.
Rgb8Image readPhotograph(const std::string& path);

/// Portable float map, exact to the bit (NaN included): little-endian, bottom row first, as the format has
/// it.
void writePfm(const std::string& path, const LinearImage& image);
void writePfm(const std::string& path, const DepthImage& image);
/// Little-endian three-channel ("PF") and one-channel ("Pf") maps.
LinearImage readLinearPfm(const std::string& path);
DepthImage readDepthPfm(const std::string& path);

}  // namespace sunlit::image
