/// The folder that a time-lapse is made in, frame by frame, over any number of runs.
#pragma once

#include <string>
#include <vector>

#include "sunlit/image/images.h"
#include "tools/recipe.h"

namespace sunlit::tools {

/// Whether a file of this name is one of the folder's frames.
bool isFrame(const std::string& name);

class FrameFolder {
 public:
  /// Throws std::runtime_error if the folder's frames were made by another `recipe`, or by nobody knows
  /// which; or if it cannot be made.
  FrameFolder(const std::string& folder, const std::vector<std::string>& recipe);

  /// Whether the frame is there, whole, and of this size.
  bool has(int frame, int width, int height) const;
  image::Rgb8Image read(int frame) const;
  /// As FolderRecipe::note(): before the first frame is written.
  void begin(const std::string& fingerprint) const { recipe_.note(fingerprint); }
  /// The whole frame, or nothing. Throws std::runtime_error where nothing can be written.
  void write(int frame, const image::Rgb8Image& picture);

 private:
  std::string file(int frame) const;

  std::string folder_;
  FolderRecipe recipe_;
};

}  // namespace sunlit::tools
