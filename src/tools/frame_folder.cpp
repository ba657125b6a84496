#include "tools/frame_folder.h"

#include <cstdio>
#include <filesystem>
#include <regex>
#include <stdexcept>
#include <system_error>

#include "sunlit/image/files.h"

namespace sunlit::tools {

bool isFrame(const std::string& name) {
  static const std::regex frame("frame_[0-9]{5,}\\.png");
  return std::regex_match(name, frame);
}

namespace {

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
    : folder_(folder), recipe_(folder, "timelapse", recipe) {
  recipe_.requireNoStranger(anyFrame(folder_));
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
  image::writePng(file(frame), picture);
}

}  // namespace sunlit::tools
