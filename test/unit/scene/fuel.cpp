// Models of Fuel, Gazebo's server, from the folders in which its tools keep what they have downloaded.
#include <gtest/gtest.h>

#include <string>

#include "unit/scene/fuel_files.h"

namespace sunlit::scene {
namespace {

using Fuel = FuelFiles;

TEST_F(Fuel, ModelsAreFoundByOwnerNameAndVersion) {
  keep("fuel.gazebosim.org/openrobotics/models/ice cream van/2", 2);
  keep("fuel.gazebosim.org/openrobotics/models/ice cream van/10", 10);
  const std::string address = "https://fuel.gazebosim.org/1.0/OpenRobotics/models/Ice Cream Van";
  EXPECT_EQ(widthOf(address), 10.0f);  // the newest, by number and not by letters
  EXPECT_EQ(widthOf(address + "/tip"), 10.0f);
  EXPECT_EQ(widthOf(address + "/2"), 2.0f);
  EXPECT_EQ(widthOf("https://fuel.gazebosim.org/1.0/OpenRobotics/models/Ice%20Cream%20Van/2/"), 2.0f);
  EXPECT_EQ(widthOf("http://fuel.gazebosim.org/openrobotics/models/ice cream van"), 10.0f);
}

TEST_F(Fuel, TheServersOldNameIsTheSameServer) {
  keep("fuel.ignitionrobotics.org/openrobotics/models/van/1", 1);
  EXPECT_EQ(widthOf("https://fuel.gazebosim.org/1.0/OpenRobotics/models/van"), 1.0f);
  keep("fuel.gazebosim.org/openrobotics/models/van/3", 3);
  EXPECT_EQ(widthOf("https://fuel.gazebosim.org/1.0/OpenRobotics/models/van"), 3.0f);  // its own name first
  keep("fuel.example.org/openrobotics/models/bus/4", 4);
  EXPECT_NE(errorOf(including("https://fuel.gazebosim.org/1.0/OpenRobotics/models/bus"), cached()), "");
  EXPECT_EQ(widthOf("https://fuel.example.org/1.0/OpenRobotics/models/bus"), 4.0f);
}

TEST_F(Fuel, FilesOfModelsAreFound) {
  keep("fuel.gazebosim.org/openrobotics/models/van/7", 7);
  const std::string world = worldOf(
      "<model name='a'><link name='l'><visual name='v'><geometry><mesh><uri>https://fuel.gazebosim.org/1.0/"
      "openrobotics/models/van/tip/files/meshes/t.obj</uri></mesh></geometry></visual></link></model>");
  EXPECT_EQ(boundsOf(load(world, cached())).max().x(), 7.0f);
}

TEST_F(Fuel, WhatIsNotInTheCacheIsNamedWithThatNothingIsFetched) {
  keep("fuel.gazebosim.org/openrobotics/models/van/7", 7);
  const std::string address = "https://fuel.gazebosim.org/1.0/openrobotics/models/van/8";
  const std::string world = including(address);
  EXPECT_EQ(errorOf(world, cached()),
            world + ":1: there is no " + address + "; looked for in Fuel's cache in " + pathOf("fuel") +
                "; nothing is fetched from the network, `gz fuel download -u ADDRESS` does that"
                "; --missing warn (of launch files missing:=warn, of nodes missing: warn) draws the rest");
  EXPECT_NE(errorOf(world).find("Fuel's cache, which has no folder; nothing is fetched"), std::string::npos);
  const std::string mesh = worldOf("<model name='m'><link name='l'><visual name='v'><geometry><mesh><uri>" +
                                   address + "/files/m.obj</uri></mesh></geometry></visual></link></model>");
  EXPECT_NE(errorOf(mesh, cached())
                .find("m.obj; nothing is fetched from the network, `gz fuel download -u ADDRESS` does that; "
                      "--missing warn"),
            std::string::npos)
      << errorOf(mesh, cached());
}

TEST_F(Fuel, TheGroundAndTheSunThatMostWorldsBeginWithNeedNoCache) {
  const auto model = [](const std::string& content) {
    return "<sdf version='1.6'><model name='m'><link name='l'>" + content + "</link></model></sdf>";
  };
  write("own/ground_plane/model.config", "<model><sdf version='1.6'>model.sdf</sdf></model>");
  write("own/ground_plane/model.sdf",
        model("<visual name='v'><geometry><box><size>8 1 1</size></box></geometry></visual>"));
  write("own/sun/model.config", "<model><sdf version='1.6'>model.sdf</sdf></model>");
  write("own/sun/model.sdf", model(""));
  SearchPath path = cached();
  path.folders = {pathOf("own")};
  const std::string begin = "<include><uri>https://fuel.gazebosim.org/1.0/OpenRobotics/models/";
  const std::string world = worldOf(begin + "Sun</uri></include>" + begin + "Ground%20Plane</uri></include>");
  EXPECT_EQ(boundsOf(load(world, path)).max().x(), 4.0f);
  // One that was downloaded comes first.
  keep("fuel.gazebosim.org/openrobotics/models/ground plane/1", 7);
  EXPECT_EQ(boundsOf(load(world, path)).max().x(), 7.0f);
  EXPECT_NE(errorOf(including("https://fuel.gazebosim.org/1.0/someone/models/Sun"), path), "");
}

TEST_F(Fuel, NoAddressLeavesTheCache) {
  keep("fuel.gazebosim.org/openrobotics/models/van/7", 7);
  keep("elsewhere", 8);
  const std::string address = "https://fuel.gazebosim.org/1.0/openrobotics/models/van/7/";
  EXPECT_EQ(widthOf(address), 7.0f);
  EXPECT_NE(errorOf(including(address + "../../../../../elsewhere"), cached()), "");
}

}  // namespace
}  // namespace sunlit::scene
