/// A folder for the files of one test, gone when it ends.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "sunlit/image/texture_files.h"
#include "sunlit/scene/load.h"
#include "support/message_of.h"

namespace sunlit::scene {

class TemporaryFolder : public ::testing::Test {
 protected:
  TemporaryFolder() { std::filesystem::create_directories(folder_); }
  ~TemporaryFolder() override { std::filesystem::remove_all(folder_); }

  std::string pathOf(const std::string& name) const { return (folder_ / name).string(); }

  std::string write(const std::string& name, const std::string& content) const {
    const std::filesystem::path path = folder_ / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << content;
    return path.string();
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
  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() /
      (std::string("sunlit_") + ::testing::UnitTest::GetInstance()->current_test_info()->name() + "_" +
       std::to_string(getpid()));
};

}  // namespace sunlit::scene
