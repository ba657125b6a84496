#include "tools/frame_folder.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <regex>
#include <stdexcept>
#include <system_error>

#include "sunlit/image/files.h"
#include "tools/output_folder.h"

namespace sunlit::tools {

namespace {

constexpr const char* kHeading =
    "# How these frames were made. timelapse adds to them only with the same options.\n";

std::vector<std::string> linesOf(const std::string& file) {
  std::ifstream in(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] != '#') lines.push_back(line);
  }
  return lines;
}

/// The first line of `a` that `b` lacks; empty if there is none.
std::string missing(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  const auto lacks = [&](const std::string& line) { return std::find(b.begin(), b.end(), line) == b.end(); };
  const auto found = std::find_if(a.begin(), a.end(), lacks);
  return found == a.end() ? std::string() : *found;
}

/// How `before` differs from `now`, in words.
std::string difference(const std::vector<std::string>& before, const std::vector<std::string>& now) {
  const std::string was = missing(before, now), is = missing(now, before);
  if (!was.empty()) return "with " + was;
  return is.empty() ? "in another order" : "without " + is;
}

bool isFrame(const std::string& name) {
  static const std::regex frame("frame_[0-9]{5,}\\.png");
  return std::regex_match(name, frame);
}

/// The first picture in `folder` that has the name of a frame; empty if there is none.
std::string anyFrame(const std::string& folder) {
  std::error_code error;  // no such folder: no frame
  std::string first;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (isFrame(name) && (first.empty() || name < first)) first = name;
  }
  return first;
}

}  // namespace

FrameFolder::FrameFolder(const std::string& folder, const std::vector<std::string>& recipe)
    : folder_(folder), recipe_(recipe) {
  requireFolderCanBeMade(folder_);
  if (!std::filesystem::exists(recipeFile())) {
    const std::string stranger = anyFrame(folder_);
    if (stranger.empty()) return;
    throw std::runtime_error(folder_ + ": holds " + stranger +
                             ", but no timelapse.txt that says how it was made; take another folder");
  }
  const std::vector<std::string> before = linesOf(recipeFile());
  if (before == recipe) return;
  throw std::runtime_error(folder_ + ": its frames were made with other options (" +
                           difference(before, recipe) + "); take another folder");
}

std::string FrameFolder::file(int frame) const {
  char name[32];
  std::snprintf(name, sizeof name, "/frame_%05d.png", frame);
  return folder_ + name;
}

bool FrameFolder::has(int frame, int width, int height) const {
  if (!std::filesystem::exists(file(frame))) return false;
  try {
    const image::Rgb8Image picture = read(frame);
    return picture.width == width && picture.height == height;
  } catch (const std::runtime_error&) {
    return false;  // broken: it is made again
  }
}

image::Rgb8Image FrameFolder::read(int frame) const {
  return image::readPng(file(frame));
}

void FrameFolder::write(int frame, const image::Rgb8Image& picture) {
  if (!std::filesystem::exists(recipeFile())) {
    makeFolder(folder_);
    std::string text = kHeading;
    for (const std::string& line : recipe_) text += line + '\n';
    image::writeFileAtomically(recipeFile(), text);
  }
  image::writePng(file(frame), picture);
}

}  // namespace sunlit::tools
