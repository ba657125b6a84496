// Includes that are merged into the model that includes them.
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "unit/scene/measure.h"
#include "unit/scene/scene_files.h"
#include "unit/scene/sdf_texts.h"

namespace sunlit::scene {
namespace {

class SdfMerge : public SceneFiles {
 protected:
  Scene loaded(const std::string& text) { return load(write("test.world", text), {}); }
};

/// Bounds of the mesh of that name.
Eigen::AlignedBox3f boundsOf(const Scene& scene, const std::string& mesh) {
  Eigen::AlignedBox3f box;
  for (const Mesh& one : scene.meshes) {
    if (one.name != mesh) continue;
    for (const Eigen::Vector3f& position : one.positions) box.extend(position);
  }
  return box;
}

// As in libsdformat's documentation of merge="true": a robot that takes its arm from another file, whose
// links and frames stand as if written in the robot, in the arm's frame.
TEST_F(SdfMerge, AreWrittenOutInTheModel) {
  write("models/hand/model.sdf",
        "<?xml version='1.0'?><sdf version='1.9'><model name='hand'><link name='finger'>"
        "<pose>0 0 1 0 0 0</pose>" +
            boxVisual() + "</link></model></sdf>");
  write(
      "models/arm/model.sdf",
      "<?xml version='1.0'?><sdf version='1.9'><model name='arm'><pose>0 0 70 0 0 0</pose>"
      "<frame name='tip'><pose>4 0 0 0 0 1.5707963267948966</pose></frame>"
      "<link name='upper'><pose>1 0 0 0 0 0</pose>" +
          boxVisual() + "</link><link name='lower'><pose relative_to='tip'>0 3 0 0 0 0</pose>" +
          boxVisual("0 0 0.5 0 0 0") +
          "</link><model name='elbow'><pose relative_to='upper'>0 0 2 0 0 0</pose><link name='l'>" +
          boxVisual() +
          "</link></model><include><uri>model://hand</uri><pose relative_to='tip'>0 0 9 0 0 "
          "0</pose></include>"
          "<include merge='true'><uri>model://hand</uri><name>other</name><pose>0 20 0 0 0 0</pose></include>"
          "</model></sdf>");
  // What the robot itself says of it: a link on a frame of the arm, one on its link, one on its nested model,
  // one on what the arm merges.
  const std::string own =
      "<pose>100 0 0 0 0 0.5</pose><link name='base'><pose relative_to='tip'>0 0 5 0 0 0</pose>" +
      boxVisual() + "</link><link name='cap'><pose relative_to='lower'>0 0 -3 0 0 0</pose>" + boxVisual() +
      "</link><frame name='f' attached_to='elbow'/><link name='pad'><pose relative_to='f'>0 0 30 0 0 "
      "0</pose>" +
      boxVisual() + "</link><link name='nail'><pose relative_to='finger'>0 0 -8 0 0 0</pose>" + boxVisual() +
      "</link>";
  const auto written = [&](const std::string& arm_pose) {
    return world(
        "<model name='robot'>" + own + "<frame name='arm'><pose>" + arm_pose +
        "</pose></frame><frame name='tip' attached_to='arm'><pose>4 0 0 0 0 1.5707963267948966</pose>"
        "</frame><link name='upper'><pose relative_to='arm'>1 0 0 0 0 0</pose>" +
        boxVisual() + "</link><link name='lower'><pose relative_to='tip'>0 3 0 0 0 0</pose>" +
        boxVisual("0 0 0.5 0 0 0") +
        "</link><model name='elbow'><pose relative_to='upper'>0 0 2 0 0 0</pose><link name='l'>" +
        boxVisual() +
        "</link></model><model name='hand'><pose relative_to='tip'>0 0 9 0 0 0</pose>"
        "<link name='finger'><pose>0 0 1 0 0 0</pose>" +
        boxVisual() + "</link></model><link name='finger'><pose relative_to='arm'>0 20 1 0 0 0</pose>" +
        boxVisual() + "</link></model>");
  };
  const auto merged = [&](const std::string& more) {
    return world("<model name='robot'>" + own + "<include merge='true'><uri>model://arm</uri>" + more +
                 "</include></model>");
  };
  // Its own pose; the include's; and the include's for a frame of it: the tip is 4 m ahead and turned left,
  // so that the arm lies to its right and looks to its back.
  const std::vector<std::array<std::string, 2>> cases = {
      {"", "0 0 70 0 0 0"},
      {"<pose>7 8 9 0.1 0.2 0.3</pose>", "7 8 9 0.1 0.2 0.3"},
      {"<placement_frame>tip</placement_frame><pose>0 0 10 0 0 0</pose>", "0 4 10 0 0 -1.5707963267948966"}};
  for (const auto& [include, pose] : cases) {
    const Scene expected = loaded(written(pose)), scene = loaded(merged(include));
    for (const std::string& warning : scene.warnings) ADD_FAILURE() << warning;
    EXPECT_EQ(scene.meshes.size(), 9u);
    ASSERT_EQ(scene.meshes.size(), expected.meshes.size());
    for (const Mesh& mesh : expected.meshes) {
      const Eigen::AlignedBox3f right = boundsOf(expected, mesh.name), box = boundsOf(scene, mesh.name);
      // Of 100 m, whose floats are 8e-6 apart.
      EXPECT_LT((box.min() - right.min()).norm() + (box.max() - right.max()).norm(), 3e-5f) << mesh.name;
    }
  }
}

TEST_F(SdfMerge, LeaveNamesToTheModel) {
  write("models/arm/model.sdf",
        "<?xml version='1.0'?><sdf version='1.9'><model name='arm'><link name='base'><light name='bulb' "
        "type='point'/>" +
            boxVisual() + "</link></model></sdf>");
  const Scene scene = loaded(world(
      "<model name='robot'><include merge='true'><uri>model://arm</uri><pose>50 0 0 0 0 0</pose></include>"
      "<link name='base'>" +
      boxVisual() + "</link><link name='on'><pose relative_to='base'>0 0 10 0 0 0</pose>" + boxVisual() +
      "</link></model>"));
  EXPECT_EQ(boundsOf(scene, "robot::on::v").min(), Eigen::Vector3f(-1, -2, 7));
  EXPECT_EQ(boundsOf(scene, "robot::base::v").max().x(), 51.0f);  // both
  ASSERT_EQ(scene.lamps.size(), 1u);
  EXPECT_EQ(scene.lamps[0].group, "robot");
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_EQ(
      scene.warnings[0],
      "1 names of merged models are taken where they are included, they mean what is written there: base "
      "of " +
          pathOf("test.world") + ":1");
}

}  // namespace
}  // namespace sunlit::scene
