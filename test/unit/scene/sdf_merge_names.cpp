// What a model may call that merges another into itself.
#include <gtest/gtest.h>

#include <string>

#include "unit/scene/measure.h"
#include "unit/scene/scene_files.h"
#include "unit/scene/sdf_texts.h"

namespace sunlit::scene {
namespace {

class SdfMergeNames : public SceneFiles {
 protected:
  /// A model that merges an arm, whose link `l` stands at x = 50 with the joint `j` 3 m above it.
  Scene robotOf(const std::string& content, const std::string& joints = kJoint) const {
    write("models/arm/model.sdf",
          "<?xml version='1.0'?><sdf version='1.9'><model name='arm'><link name='l'>"
          "<pose>50 0 0 0 0 0</pose>" +
              boxVisual() + "</link>" + joints + "</model></sdf>");
    return load(write("test.world", world("<model name='robot'>" + content + "</model>")), {});
  }

  static constexpr const char* kJoint =
      "<joint name='j' type='fixed'><pose>0 0 3 0 0 0</pose><parent>world</parent><child>l</child></joint>";
};

std::string including(const std::string& more = "") {
  return "<include merge='true'><uri>model://arm</uri>" + more + "</include>";
}

TEST_F(SdfMergeNames, JointsAreFramesToTheParent) {
  const std::string pad = "<link name='pad'><pose relative_to='";
  const std::string box = "'>0 0 10 0 0 0</pose>" + boxVisual() + "</link>";
  Scene scene = robotOf(including() + pad + "j" + box);
  EXPECT_EQ(boundsOf(scene).max(), Eigen::Vector3f(51, 2, 16));
  EXPECT_TRUE(scene.warnings.empty());
  scene = robotOf(including() + "<frame name='f' attached_to='j'/>" + pad + "f" + box);
  EXPECT_EQ(boundsOf(scene).max(), Eigen::Vector3f(51, 2, 16));
  scene = robotOf(including("<placement_frame>j</placement_frame>"));
  EXPECT_EQ(boundsOf(scene).max(), Eigen::Vector3f(1, 2, 0));
}

TEST_F(SdfMergeNames, JointsThatAreNoFramesStopNothing) {
  const std::string broken =
      "<joint name='l' type='fixed'><parent>world</parent><child>l</child></joint>"
      "<joint name='a' type='fixed'><parent>l</parent><child>nowhere</child></joint>"
      "<joint name='b' type='fixed'><pose relative_to='nowhere'>0 0 0 0 0 0</pose><parent>world</parent>"
      "<child>l</child></joint>";
  const Scene scene = robotOf(including(), broken);
  EXPECT_EQ(boundsOf(scene).max().x(), 51.0f);
  EXPECT_TRUE(scene.warnings.empty());
}

TEST_F(SdfMergeNames, PluginsTakeNone) {
  EXPECT_TRUE(robotOf("<plugin name='l' filename='x.so'/>" + including()).warnings.empty());
  EXPECT_EQ(robotOf("<link name='l'/>" + including()).warnings.size(), 1u);
}

TEST_F(SdfMergeNames, OfScopesAndOfTwiceTheSameAreAccepted) {
  Scene scene = robotOf(including("<name>a::b</name>"));
  EXPECT_EQ(boundsOf(scene).max().x(), 51.0f);
  scene = robotOf(including("<name>a</name>") + including("<name>a</name><pose>0 30 0 0 0 0</pose>"));
  EXPECT_EQ(scene.meshes.size(), 2u);
  EXPECT_EQ(boundsOf(scene).max().y(), 32.0f);
}

}  // namespace
}  // namespace sunlit::scene
