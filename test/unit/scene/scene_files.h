/// Files of scenes that last as long as a test.
#pragma once

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "sunlit/image/texture_files.h"
#include "sunlit/scene/load.h"
#include "support/message_of.h"
#include "support/temporary_folder.h"

namespace sunlit::scene {

class SceneFiles : public ::testing::Test {
 protected:
  std::string pathOf(const std::string& name) const { return folder_.file(name); }

  /// The path of the file.
  std::string write(const std::string& name, const std::string& content) const {
    setContent(pathOf(name), content);
    return pathOf(name);
  }

  /// A 4 × 4 px PNG of one colour whose left `transparent_columns` columns have alpha 0.
  void writeTexture(const std::string& name, int transparent_columns = 0) const {
    image::Rgba8Image picture(4, 4);
    for (int y = 0; y < 4; ++y) {
      for (int x = 0; x < 4; ++x) {
        std::uint8_t* texel = picture.at(x, y);
        texel[0] = 200;
        texel[1] = 100;
        texel[2] = 50;
        texel[3] = x < transparent_columns ? 0 : 255;
      }
    }
    write(name, image::encodePng(picture));
  }

  /// The error of loading `file`; empty if it loads.
  static std::string errorOf(const std::string& file, const SearchPath& search_path = {}) {
    return messageOf<std::runtime_error>([&] { load(file, search_path); });
  }

 private:
  const TemporaryFolder folder_;
};

}  // namespace sunlit::scene
