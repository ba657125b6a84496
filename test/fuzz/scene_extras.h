/// Files that lie beside those of scenes, as they should be.
#pragma once

#include <string>

#include "sunlit/image/texture_files.h"
#include "sunlit/scene/scene.h"
#include "support/temporary_folder.h"

namespace sunlit::fuzz {

/// A PNG of so many px a side, brighter to the right.
inline std::string slope(int side) {
  image::Rgba8Image picture(side, side);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      std::uint8_t* const texel = picture.at(x, y);
      texel[0] = texel[1] = static_cast<std::uint8_t>(255 * x / side);
      texel[2] = static_cast<std::uint8_t>(128 + y);
      texel[3] = x < y ? 100 : 255;
    }
  }
  return image::encodePng(picture);
}

/// paint.png and triangle.obj in the current folder, written once.
inline void layExtras() {
  static const bool laid = [] {
    setContent("./paint.png", slope(9));
    setContent("./triangle.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n");
    return true;
  }();
  static_cast<void>(laid);
}

/// A scene that is no good, though nobody said so, throws.
inline void requireGood(const scene::Scene& scene) {
  scene::validate(scene);
}

}  // namespace sunlit::fuzz
