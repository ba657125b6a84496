// Addresses of Fuel as they are written, and folders as different tools name them.
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>

#include "unit/scene/fuel_files.h"

namespace sunlit::scene {
namespace {

using FuelSpellings = FuelFiles;

const std::string kServer = "https://fuel.gazebosim.org/1.0/";

TEST_F(FuelSpellings, BlanksAreFoundHoweverTheyAreKept) {
  keep("fuel.gazebosim.org/o/models/cricket ball/1", 1);
  keep("fuel.gazebosim.org/o/models/ice%20van/2", 2);
  keep("fuel.gazebosim.org/o/models/Big%20Van/3", 3);
  EXPECT_EQ(widthOf(kServer + "o/models/Cricket%20Ball"), 1.0f);
  EXPECT_EQ(widthOf(kServer + "o/models/Cricket Ball"), 1.0f);
  EXPECT_EQ(widthOf(kServer + "o/models/Ice%20Van"), 2.0f);
  EXPECT_EQ(widthOf(kServer + "o/models/Ice Van"), 2.0f);
  EXPECT_EQ(widthOf(kServer + "o/models/Big%20Van"), 3.0f);
}

TEST_F(FuelSpellings, PortsAreFoundHoweverTheyAreKept) {
  keep("localhost:8000/o/models/van/1", 1);
  keep("localhost%3A9000/o/models/van/2", 2);
  EXPECT_EQ(widthOf("http://localhost:8000/1.0/o/models/van"), 1.0f);
  EXPECT_EQ(widthOf("http://localhost:9000/1.0/o/models/van"), 2.0f);
}

TEST_F(FuelSpellings, EscapesDoNotLeaveTheCache) {
  keep("fuel.gazebosim.org/o/models/van/7", 7);
  keep("elsewhere", 8);
  const std::string address = kServer + "o/models/van/7/";
  for (const std::string up : {"..", "%2e%2e", ".%2E", "%2e."}) {
    for (const std::string slash : {"/", "%2f", "%2F"}) {
      std::string way = address;
      for (int i = 0; i < 5; ++i) way += up + slash;
      EXPECT_NE(errorOf(including(way + "elsewhere"), cached()), "") << way;
    }
  }
  EXPECT_NE(errorOf(including(address + "files/%2F" + pathOf("fuel/elsewhere")), cached()), "");
  std::string escaped;
  for (const char letter : pathOf("fuel/elsewhere"))
    escaped += letter == '/' ? "%2F" : std::string(1, letter);
  EXPECT_NE(errorOf(including(address + "files/" + escaped), cached()), "");
}

TEST_F(FuelSpellings, InterruptedDownloadsHideNoOlderVersion) {
  keep("fuel.gazebosim.org/o/models/van/1", 1);
  write("fuel/fuel.gazebosim.org/o/models/van/2/meshes/t.obj", "");
  EXPECT_EQ(widthOf(kServer + "o/models/van"), 1.0f);
  keep("fuel.gazebosim.org/o/models/van/2", 2);
  EXPECT_EQ(widthOf(kServer + "o/models/van"), 2.0f);
}

TEST_F(FuelSpellings, WorldsAreTheOneInTheirFolder) {
  const std::string folder = "fuel/fuel.gazebosim.org/o/worlds/shapes/";
  const std::string box =
      "<?xml version='1.0'?><sdf version='1.9'><world name='w'><model name='m'><link name='l'><visual "
      "name='v'><geometry><box><size>2 2 2</size></box></geometry></visual></link></model></world></sdf>";
  write(folder + "1/shapes.sdf", box);
  write(folder + "1/._shapes.sdf", "left by macOS");
  write(folder + "1/thumbnails/1.png", "");
  std::filesystem::create_directories(pathOf(folder + "2"));
  const std::string address = kServer + "o/worlds/shapes";
  EXPECT_EQ(boundsOf(load(address, cached())).max().x(), 1.0f);
  EXPECT_EQ(errorOf(pathOf(folder)),
            pathOf(folder) + ": there is no world in this folder, of names that end in .world or .sdf");
  write(folder + "3/a.sdf", box);
  write(folder + "3/b.sdf", box);
  EXPECT_EQ(errorOf(address, cached()),
            pathOf(folder + "3") +
                ": there are 2 worlds in this folder, of names that end in .world or .sdf, the first of them "
                "a.sdf and b.sdf: name one of them");
  EXPECT_EQ(boundsOf(load(address + "/3/files/b.sdf", cached())).max().x(), 1.0f);
}

TEST_F(FuelSpellings, TexturesAreThoseOfTheirAddress) {
  const auto paint = [&](const std::string& name, std::uint8_t red) {
    image::Rgba8Image picture(1, 1);
    picture.data = {red, 0, 0, 255};
    write(name, image::encodePng(picture));
  };
  paint("textures/wood.png", 10);
  paint("fuel/fuel.gazebosim.org/o/models/plank/1/materials/textures/wood.png", 200);
  const auto redOf = [&](const std::string& uri) {
    const std::string world = worldOf(
        "<model name='m'><link name='l'><visual name='v'><geometry><box><size>1 1 1</size></box></geometry>"
        "<material><pbr><metal><albedo_map>" +
        uri + "</albedo_map></metal></pbr></material></visual></link></model>");
    return static_cast<int>(load(world, cached()).textures.at(0).rgba[0]);
  };
  EXPECT_EQ(redOf(kServer + "o/models/plank/1/files/materials/textures/wood.png"), 200);
  paint("models/plank/materials/textures/wood.png", 100);
  EXPECT_EQ(redOf("model://plank/materials/textures/wood.png"), 100);
  EXPECT_EQ(redOf("file://elsewhere/wood.png"), 10);  // of another machine: by its name
}

}  // namespace
}  // namespace sunlit::scene
