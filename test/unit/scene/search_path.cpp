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

}  // namespace
}  // namespace sunlit::scene
