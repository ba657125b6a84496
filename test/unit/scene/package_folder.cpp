#include "scene/package_folder.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <string>

#include "support/temporary_folder.h"

namespace sunlit::scene {
namespace {

/// Two workspaces in ROS_PACKAGE_PATH, with one test's packages. What is found is remembered, so each has
/// names of its own.
class PackageFolder : public testing::Test {
 protected:
  void SetUp() override {
    setenv("ROS_PACKAGE_PATH",
           (folder_.file("first") + ":/no/such/folder::" + folder_.file("second")).c_str(), 1);
    std::filesystem::create_directories(folder_.file("first"));
  }
  void TearDown() override { unsetenv("ROS_PACKAGE_PATH"); }
  /// Its folder.
  std::string add(const std::string& place, const std::string& name) {
    setContent(folder_.file(place + "/package.xml"),
               "<?xml version='1.0'?>\n<package format='2'>\n  <name> " + name + "\n</name></package>\n");
    return folder_.file(place);
  }
  TemporaryFolder folder_;
};

TEST_F(PackageFolder, IsKnownByTheNameInItsManifest) {
  const std::string folder = add("second/src/group/called_otherwise", "pf_named");
  EXPECT_EQ(packageFolder("pf_named"), folder);
  EXPECT_EQ(packageFolder("called_otherwise"), "");
  EXPECT_EQ(packageFolder(""), "");
}

TEST_F(PackageFolder, OfTheFirstWorkspaceComesFirst) {
  add("second/a", "pf_twice");
  const std::string first = add("first/z", "pf_twice");
  EXPECT_EQ(packageFolder("pf_twice"), first);
}

TEST_F(PackageFolder, IsNotLookedForWhereRospackDoesNot) {
  add("first/outer", "pf_outer");
  add("first/outer/inner", "pf_within_another");
  add("first/.hidden/one", "pf_hidden");
  add("first/built/one", "pf_ignored");
  setContent(folder_.file("first/built/CATKIN_IGNORE"), "");
  setContent(folder_.file("first/broken/package.xml"), "<package");
  for (const char* name : {"pf_within_another", "pf_hidden", "pf_ignored"})
    EXPECT_EQ(packageFolder(name), "") << name;
}

TEST_F(PackageFolder, IsFoundBehindLinksThatMayLeadInARing) {
  add("elsewhere/linked", "pf_linked");
  std::filesystem::create_directory_symlink(folder_.file("elsewhere"), folder_.file("first/link"));
  std::filesystem::create_directory_symlink(folder_.file("first"), folder_.file("first/ring"));
  std::filesystem::create_directory_symlink(folder_.file("nowhere"), folder_.file("first/dangling"));
  EXPECT_EQ(packageFolder("pf_linked"), folder_.file("first/link/linked"));
  EXPECT_EQ(packageFolder("pf_nowhere"), "");
}

}  // namespace
}  // namespace sunlit::scene
