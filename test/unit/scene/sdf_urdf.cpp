// URDF files that SDF includes.
#include <gtest/gtest.h>

#include <string>

#include "unit/scene/measure.h"
#include "unit/scene/scene_files.h"
#include "unit/scene/sdf_texts.h"

namespace sunlit::scene {
namespace {

const std::string kMass =
    "<inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial>";
const std::string kUnitBox = "<geometry><box size='1 1 1'/></geometry>";

std::string linkOf(const std::string& name, const std::string& visual) {
  return "<link name='" + name + "'><visual>" + visual + "</visual>" + kMass + "</link>";
}

class SdfUrdf : public SceneFiles {
 protected:
  Scene included(const std::string& include, const SearchPath& search_path = {}) const {
    return load(write("w.world", world("<include>" + include + "</include>")), search_path);
  }
  static const Material& look(const Scene& scene) {
    return scene.materials.at(static_cast<std::size_t>(scene.meshes.at(0).material));
  }
};

TEST_F(SdfUrdf, IsAModelByAManifestOrByItself) {
  write("models/shed/model.config", "<model><name>shed</name><sdf version='1.6'>shed.urdf</sdf></model>");
  write("models/named/model.config", "<model><name>named</name><urdf>../shed/shed.urdf</urdf></model>");
  write("models/shed/shed.urdf",
        "<robot name='shed'>" +
            linkOf("base", kUnitBox + "<material name='red'><color rgba='1 0 0 1'/></material>") +
            linkOf("arm", kUnitBox) +
            "<joint name='j' type='revolute'><parent link='base'/><child link='arm'/><origin xyz='0 0 2'/>"
            "<axis xyz='1 0 0'/><limit lower='-1' upper='1' effort='1' velocity='1'/></joint></robot>");
  for (const std::string uri : {"model://shed", "model://named", "models/shed/shed.urdf"}) {
    const Scene scene = included("<uri>" + uri + "</uri><name>s</name><pose>10 0 0 0 0 0</pose>");
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
    ASSERT_EQ(scene.meshes.size(), 2u) << uri;
    EXPECT_TRUE((look(scene).base_color.value == Eigen::Array3f(1, 0, 0)).all());
    EXPECT_LT((boundsOf(scene).min() - Eigen::Vector3f(9.5f, -0.5f, -0.5f)).norm(), 1e-5f);
    EXPECT_LT((boundsOf(scene).max() - Eigen::Vector3f(10.5f, 0.5f, 2.5f)).norm(), 1e-5f);
  }
}

TEST_F(SdfUrdf, HasMeshesOfPackagesAndNoPictures) {
  write("packages/p/meshes/m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::string picture = "<material name='bark'><texture filename='bark.png'/></material>";
  write("tree.urdf", "<robot name='tree'>" + picture +
                         linkOf("base",
                                "<geometry><mesh filename='package://p/meshes/m.obj'/></geometry>"
                                "<material name='bark'/>") +
                         "</robot>");
  SearchPath search_path;
  search_path.package_folder = [&](const std::string& package) { return pathOf("packages/" + package); };
  const Scene scene = included("<uri>tree.urdf</uri>", search_path);
  EXPECT_EQ(scene.triangleCount(), 1u);
  EXPECT_GT(look(scene).base_color.value.minCoeff(), 0.1f);
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_NE(scene.warnings[0].find("material bark of " + pathOf("tree.urdf")), std::string::npos)
      << scene.warnings[0];
}

// Exporters of modellers write an empty picture beside each colour, and no names.
TEST_F(SdfUrdf, ColoursBesidePicturesRemain) {
  const std::string red = "<color rgba='1 0 0 1'/>", green = "<color rgba='0 1 0 1'/>";
  const auto made = [&](const std::string& global, const std::string& own) {
    write("r.urdf", "<robot name='r'>" + global + linkOf("base", kUnitBox + own) + "</robot>");
    return included("<uri>r.urdf</uri>");
  };
  const auto named = [](const std::string& name, const std::string& content) {
    return "<material name='" + name + "'>" + content + "</material>";
  };
  const std::string none = "<texture filename=''/>", picture = "<texture filename='bark.png'/>";
  const Scene exported = made("", named("", red + none));
  EXPECT_TRUE(exported.warnings.empty()) << exported.warnings[0];
  EXPECT_TRUE((look(exported).base_color.value == Eigen::Array3f(1, 0, 0)).all());
  // What has no name is not what else has none.
  const Scene other = made(named("", picture), named("", green));
  EXPECT_TRUE((look(other).base_color.value == Eigen::Array3f(0, 1, 0)).all());
  const Scene both = made(named("bark", red + picture), named("bark", ""));
  EXPECT_TRUE((look(both).base_color.value == Eigen::Array3f(1, 0, 0)).all());
  ASSERT_EQ(both.warnings.size(), 1u);
  EXPECT_NE(both.warnings[0].find(": in its colour"), std::string::npos) << both.warnings[0];
  // A picture that is nowhere is no loss, and no black.
  const Scene neither = made("", named("", none));
  EXPECT_TRUE(neither.warnings.empty()) << neither.warnings[0];
  EXPECT_GT(look(neither).base_color.value.minCoeff(), 0.1f);
}

TEST_F(SdfUrdf, LinksWithoutAMassAreLeftOutAndNamedButAtFixedJoints) {
  const auto jointed = [&](const std::string& type) {
    write("r.urdf", "<robot name='r'>" + linkOf("base", kUnitBox) + "<link name='arm'><visual>" + kUnitBox +
                        "</visual></link><joint name='j' type='" + type +
                        "'><parent link='base'/><child link='arm'/></joint></robot>");
    return included("<uri>r.urdf</uri>");
  };
  EXPECT_EQ(jointed("fixed").meshes.size(), 2u);
  EXPECT_TRUE(jointed("fixed").warnings.empty()) << jointed("fixed").warnings[0];
  const Scene scene = jointed("continuous");
  EXPECT_EQ(scene.meshes.size(), 1u);
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_NE(scene.warnings[0].find("no <inertial>: arm of " + pathOf("r.urdf")), std::string::npos)
      << scene.warnings[0];
}

// By whatever name their visuals have.
TEST_F(SdfUrdf, LinksAtFixedJointsAreLeftOutWithWhatTheyHangFrom) {
  const auto hung = [&](const std::string& type, const std::string& more = "") {
    write("r.urdf", "<robot name='r'>" + linkOf("base", kUnitBox) +
                        "<link name='arm'/><link name='cover'><visual name='shell'>" + kUnitBox +
                        "</visual></link><joint name='j' type='" + type +
                        "'><parent link='base'/><child link='arm'/></joint><joint name='k' "
                        "type='fixed'><parent link='arm'/>"
                        "<child link='cover'/></joint>" +
                        more + "</robot>");
    return included("<uri>r.urdf</uri>");
  };
  EXPECT_EQ(hung("fixed").meshes.size(), 2u);
  EXPECT_TRUE(hung("fixed").warnings.empty()) << hung("fixed").warnings[0];
  for (const Scene& scene :
       {hung("continuous"),
        hung("fixed", "<gazebo reference='k'><preserveFixedJoint>true</preserveFixedJoint></gazebo>")}) {
    EXPECT_EQ(scene.meshes.size(), 1u);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_NE(scene.warnings[0].find("no <inertial>: cover of " + pathOf("r.urdf")), std::string::npos)
        << scene.warnings[0];
  }
}

TEST_F(SdfUrdf, LinksThatHangFromEachOtherAreLeftOut) {
  const auto joint = [](const std::string& parent, const std::string& child) {
    return "<joint name='" + parent + child + "' type='fixed'><parent link='" + parent + "'/><child link='" +
           child + "'/></joint>";
  };
  write("r.urdf", "<robot name='r'>" + linkOf("base", kUnitBox) + linkOf("a", kUnitBox) +
                      linkOf("b", kUnitBox) + joint("a", "b") + joint("b", "a") + "</robot>");
  const Scene scene = included("<uri>r.urdf</uri>");
  EXPECT_EQ(scene.meshes.size(), 1u);
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_EQ(scene.warnings[0].find("2 links of URDF files within SDF were left out"), 0u)
      << scene.warnings[0];
}

TEST_F(SdfUrdf, ThatCannotBeReadIsAnErrorThatNamesIt) {
  const std::string around = world("<include><uri>r.urdf</uri></include>");
  write("r.urdf", "<robot name='r' xmlns:xacro='x'>\n<xacro:include filename='a'/></robot>");
  const std::string macro = errorOf(write("w.world", around));
  EXPECT_NE(macro.find("r.urdf:2: <xacro:include> is a macro"), std::string::npos) << macro;
  write("r.urdf", "<robot name='r'><link name='a'/><link name='b'/></robot>");
  const std::string two_roots = errorOf(write("w.world", around));
  EXPECT_NE(two_roots.find("r.urdf: "), std::string::npos) << two_roots;
}

TEST_F(SdfUrdf, ParametersOfIncludesAreNamed) {
  write("models/crate/model.sdf",
        "<sdf version='1.9'><model name='crate'><link name='l'>" + boxVisual() + "</link></model></sdf>");
  const Scene scene = included(
      "<uri>model://crate</uri><experimental:params><visual element_id='l::v' action='remove'/>"
      "</experimental:params>");
  EXPECT_EQ(scene.meshes.size(), 1u);
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_NE(scene.warnings[0].find("<experimental:params>"), std::string::npos) << scene.warnings[0];
  // What they would include goes with them.
  const Scene nested = included(
      "<uri>model://crate</uri><experimental:params><include><uri>model://crate</uri></include>"
      "</experimental:params>");
  EXPECT_EQ(nested.meshes.size(), 1u);
  EXPECT_EQ(nested.warnings, scene.warnings);
}

// Whether the include that they are of is drawn or taken out.
TEST_F(SdfUrdf, IncludesWithinParametersOfIncludesAreNotLookedFor) {
  write("models/crate/model.sdf",
        "<sdf version='1.9'><model name='crate'><link name='l'>" + boxVisual() + "</link></model></sdf>");
  write("models/empty/model.sdf",
        "<sdf version='1.9'><light type='point' name='lamp'><diffuse>1 1 1 1</diffuse></light></sdf>");
  const std::string parameters =
      "<experimental:params><include><uri>model://none</uri></include></experimental:params>";
  const Scene scene = included("<uri>model://crate</uri>" + parameters +
                               "</include><include><uri>model://empty</uri>" + parameters);
  EXPECT_EQ(scene.meshes.size(), 1u);
  ASSERT_EQ(scene.warnings.size(), 1u) << scene.warnings[1];
  EXPECT_EQ(scene.warnings[0].find("2 includes have <experimental:params>"), 0u) << scene.warnings[0];
}

}  // namespace
}  // namespace sunlit::scene
