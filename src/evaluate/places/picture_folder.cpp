#include "sunlit/evaluate/places/picture_folder.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "sunlit/image/files.h"

namespace sunlit::evaluate {
namespace {

namespace fs = std::filesystem;

bool isDigit(char c) {
  return c >= '0' && c <= '9';
}

std::string endingOf(const std::string& name) {
  std::string ending = fs::path(name).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

bool isPicture(const std::string& name) {
  static const std::vector<std::string> endings = {".png",  ".jpg",  ".jpeg", ".bmp", ".tif",
                                                   ".tiff", ".webp", ".ppm",  ".pgm"};
  return std::find(endings.begin(), endings.end(), endingOf(name)) != endings.end();
}

/// The digits that begin at `at`, without leading zeros; `at` moves behind them.
std::string numberAt(const std::string& text, std::size_t* at) {
  const std::size_t begin = *at;
  while (*at < text.size() && isDigit(text[*at])) ++*at;
  const std::size_t first = std::min(text.find_first_not_of('0', begin), *at);
  return text.substr(first, *at - first);
}

/// -1, 0 or 1; of whole numbers of any length.
int compareNumbers(const std::string& a, const std::string& b) {
  if (a.size() != b.size()) return a.size() < b.size() ? -1 : 1;
  return a < b ? -1 : (a > b ? 1 : 0);
}

}  // namespace

bool isNamedBefore(const std::string& a, const std::string& b) {
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (isDigit(a[i]) && isDigit(b[j])) {
      const std::string left = numberAt(a, &i), right = numberAt(b, &j);
      const int order = compareNumbers(left, right);
      if (order != 0) return order < 0;
    } else {
      const auto left = static_cast<unsigned char>(a[i++]), right = static_cast<unsigned char>(b[j++]);
      if (left != right) return left < right;
    }
  }
  const bool a_ends = i == a.size(), b_ends = j == b.size();
  return a_ends == b_ends ? a < b : a_ends;
}

PictureFolder openPictureFolder(const std::string& folder) {
  PictureFolder pictures;
  pictures.folder = folder;
  std::error_code error;
  if (!fs::is_directory(folder, error))
    throw std::runtime_error(folder + (fs::exists(folder, error)
                                           ? ": is no folder, but must be one of pictures"
                                           : ": there is no such folder"));
  fs::directory_iterator entry(folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    std::error_code unknown;  // a link to nowhere is no file
    if (name[0] == '.' || !entry->is_regular_file(unknown)) continue;
    if (isPicture(name)) {
      pictures.names.push_back(name);
    } else {
      ++pictures.other_files;
    }
  }
  if (error) throw std::runtime_error(folder + ": the folder cannot be read: " + error.message());
  if (pictures.names.empty())
    throw std::runtime_error(folder +
                             ": holds no pictures (.png .jpg .jpeg .bmp .tif .tiff .webp .ppm .pgm)");
  std::sort(pictures.names.begin(), pictures.names.end(), isNamedBefore);
  return pictures;
}

Picture readPicture(const std::string& file) {
  image::Rgb8Image picture = image::readPhotograph(file);
  return makePicture(matOf(picture).clone());
}

}  // namespace sunlit::evaluate
