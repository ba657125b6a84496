#include "ros/tools/frame_folder.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "sunlit/image/files.h"

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

/// The first line of `a` that `b` lacks; empty if there is none. Both sorted.
std::string missing(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  std::vector<std::string> only;
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(only));
  return only.empty() ? std::string() : only.front();
}

}  // namespace

FrameFolder::FrameFolder(const std::string& folder, const std::vector<std::string>& recipe)
    : folder_(folder), recipe_(recipe) {
  if (!std::filesystem::exists(recipeFile())) return;
  const std::vector<std::string> before = linesOf(recipeFile());
  if (before == recipe) return;
  const std::string was = missing(before, recipe), is = missing(recipe, before);
  throw std::runtime_error(folder_ + ": its frames were made with other options (" +
                           (was.empty() ? "without " + is : "with " + was) + "); take another folder");
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
    std::error_code error;
    std::filesystem::create_directories(folder_, error);
    if (error) throw std::runtime_error(folder_ + ": the folder cannot be made: " + error.message());
    std::string text = kHeading;
    for (const std::string& line : recipe_) text += line + '\n';
    image::writeFileAtomically(recipeFile(), text);
  }
  image::writePng(file(frame), picture);
}

}  // namespace sunlit::tools
