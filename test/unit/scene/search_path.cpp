// Where files are looked for without being told.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <string>
#include <vector>

#include "scene/resource_finder.h"
#include "unit/scene/scene_files.h"

namespace sunlit::scene {
namespace {

class SearchPathOfEnvironment : public SceneFiles {
 protected:
  void TearDown() override {
    for (const char* variable : {"SDF_PATH", "GZ_SIM_RESOURCE_PATH", "IGN_GAZEBO_RESOURCE_PATH"})
      unsetenv(variable);
  }
};

TEST_F(SearchPathOfEnvironment, HasTheFoldersOfEachGazebo) {
  setenv("SDF_PATH", "/of/sdf", 1);
  setenv("GZ_SIM_RESOURCE_PATH", "/of/gz:/more", 1);
  setenv("IGN_GAZEBO_RESOURCE_PATH", "/of/ign", 1);
  const std::vector<std::string> folders = SearchPath::withEnvironment({"/own"}).folders;
  const std::vector<std::string> expected = {"/of/sdf", "/of/gz", "/more", "/of/ign"};
  EXPECT_EQ(folders.front(), "/own");
  EXPECT_NE(std::search(folders.begin(), folders.end(), expected.begin(), expected.end()), folders.end());
}

TEST_F(SearchPathOfEnvironment, HasWhatIsInstalledOfGazeboNewestFirst) {
  for (const char* file : {"gazebo-9/setup.sh", "gazebo-11/models/m.obj", "gazebo/setup.sh", "other/a"})
    write(file, "v 0 0 0\n");
  write("gazebo-12", "a file");
  const std::vector<std::string> folders = gazeboFolders(pathOf("."));
  ASSERT_EQ(folders.size(), 2u);
  EXPECT_NE(folders[0].find("gazebo-11"), std::string::npos);
  EXPECT_NE(folders[1].find("gazebo-9"), std::string::npos);
  EXPECT_TRUE(gazeboFolders(pathOf("nowhere")).empty());
  const ResourceFinder finder(SearchPath{folders}, pathOf("world/w.sdf"));
  EXPECT_TRUE(finder.find("model://m.obj", pathOf("world/w.sdf")).file.has_value());
}

class PackagesThatRosDoesNotKnow : public SceneFiles {
 protected:
  SearchPath searchPath() const {
    SearchPath search_path{{pathOf("share")}};
    search_path.package_folder = [&](const std::string& package) {
      return package == "known" ? pathOf("known") : std::string();
    };
    return search_path;
  }
};

TEST_F(PackagesThatRosDoesNotKnow, AreCalledThat) {
  const std::string unknown = "package://nope/worlds/x.world", share = pathOf("share");
  EXPECT_EQ(errorOf(unknown, searchPath()),
            "there is no world " + unknown + "; it was looked for as " + share + "/nope/worlds/x.world and " +
                share +
                "/models/nope/worlds/x.world; ROS knows no package nope, neither below ROS_PACKAGE_PATH nor "
                "in /usr/share: is its workspace sourced?");
  for (const std::string other : {"package://known/x.world", "model://nope/x.world", "nope/x.world"})
    EXPECT_EQ(errorOf(other, searchPath()).find("ROS knows"), std::string::npos) << other;
  EXPECT_NE(ResourceFinder(searchPath(), pathOf("w.sdf"))
                .rootsOf("package://nope/models/box")
                .find(share + "; ROS knows no package nope, "),
            std::string::npos);
}

TEST_F(PackagesThatRosDoesNotKnow, MayBeFoldersOfTheSearchPath) {
  const std::string file = write("share/nope/triangle.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(load("package://nope/triangle.obj", searchPath()).name, file);
}

TEST_F(SearchPathOfEnvironment, HasNoParentsOfAddressesThatAreNoFiles) {
  EXPECT_EQ(errorOf("model://a/b.world"),
            "there is no world model://a/b.world; there is no folder to look for it in");
  write("worlds/m.obj", "v 0 0 0\n");
  for (const char* scheme : {"file://", "file://localhost", "file:"}) {
    const std::string world = scheme + pathOf("worlds/w.sdf");
    EXPECT_TRUE(ResourceFinder({}, world).find("model://m.obj", world).file.has_value()) << scheme;
    EXPECT_EQ(ResourceFinder({}, "").find(scheme + pathOf("worlds/m.obj"), "").file, pathOf("worlds/m.obj"));
  }
}

}  // namespace
}  // namespace sunlit::scene
