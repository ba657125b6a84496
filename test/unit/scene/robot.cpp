// Robots from URDF and SDF: where their links are, how they look, and what is said about broken ones.
#include "sunlit/scene/robot.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "measure.h"
#include "support/message_of.h"
#include "support/needs.h"
#include "unit/scene/scene_files.h"

namespace sunlit::scene {
namespace {

constexpr double kQuarter = 1.5707963267948966;

std::string link(const std::string& name, const std::string& more = "") {
  return "<link name='" + name + "'>" + more + "</link>\n";
}

std::string visual(const std::string& geometry, const std::string& more = "") {
  return "<visual>" + more + "<geometry>" + geometry + "</geometry></visual>";
}

const std::string kBox = "<box size='2 4 6'/>";

std::string joint(const std::string& name, const std::string& type, const std::string& child,
                  const std::string& more) {
  return "<joint name='" + name + "' type='" + type + "'><parent link='base'/><child link='" + child + "'/>" +
         more + "</joint>\n";
}

std::string robotText(const std::string& content) {
  return "<?xml version='1.0'?>\n<robot name='r'>\n" + content + "</robot>";
}

Robot parsed(const std::string& content) {
  return parseUrdf(robotText(content), "some.urdf", {});
}

std::string errorOfText(const std::string& text) {
  return messageOf<std::runtime_error>([&] { parseUrdf(text, "some.urdf", {}); });
}

Eigen::Isometry3d baseFrom(const Robot& robot, const std::string& name) {
  return robot.baseFromLinks(0)[robot.indexOf(name).value()];
}

/// Of link `name` in its own frame.
Eigen::AlignedBox3f bounds(const Robot& robot, const std::string& name) {
  Eigen::AlignedBox3f box;
  for (const Mesh& mesh : robot.links[robot.indexOf(name).value()].meshes) box.extend(boundsOf(mesh));
  return box;
}

TEST(Urdf, VisualsWithoutAColourHaveTheOneThatGazeboGivesTheirLink) {
  const std::string blue = "<gazebo reference='base'><material> Gazebo/Blue </material></gazebo>";
  const Robot robot = parsed(link("base", visual(kBox)) + blue);
  EXPECT_TRUE(
      (robot.materials.at(static_cast<std::size_t>(robot.links[0].meshes[0].material)).base_color.value ==
       Eigen::Array3f(0.0f, 0.0f, 1.0f))
          .all());
  EXPECT_EQ(robot.materials[static_cast<std::size_t>(robot.links[0].meshes[0].material)].alpha_mode,
            AlphaMode::kOpaque);
  EXPECT_TRUE(robot.warnings.empty());
  const Robot own =
      parsed(link("base", visual(kBox, "<material name='red'><color rgba='1 0 0 1'/></material>")) + blue);
  EXPECT_EQ(own.materials.at(static_cast<std::size_t>(own.links[0].meshes[0].material)).base_color.value[0],
            1.0f);
  ASSERT_EQ(own.warnings.size(), 1U);
  EXPECT_NE(own.warnings[0].find("<gazebo> material Gazebo/Blue of "), std::string::npos) << own.warnings[0];
  const Robot unknown =
      parsed(link("base", visual(kBox)) + "<gazebo reference='base'><material>My/Own</material></gazebo>");
  ASSERT_EQ(unknown.warnings.size(), 1U);
  EXPECT_NE(unknown.warnings[0].find("My/Own of "), std::string::npos) << unknown.warnings[0];
}

TEST(Urdf, LinksHangFromTheirParents) {
  const Robot robot = parsed(
      link("base", visual(kBox)) + link("arm", visual(kBox)) + link("hand", visual(kBox)) +
      joint("j", "revolute", "arm",
            "<origin xyz='1 2 3' rpy='0 0 1.5707963267948966'/><axis xyz='0 0 1'/>"
            "<limit lower='-1' upper='1' effort='1' velocity='1'/>") +
      "<joint name='k' type='fixed'><parent link='arm'/><child link='hand'/><origin xyz='1 0 0'/></joint>");
  ASSERT_EQ(robot.links.size(), 3u);
  EXPECT_EQ(robot.links[0].name, "base");
  // The quarter turn carries the hand's metre forward to the left. Roundings of double.
  EXPECT_LT((baseFrom(robot, "hand").translation() - Eigen::Vector3d(1, 3, 3)).norm(), 1e-12);
  EXPECT_LT((baseFrom(robot, "hand").linear() -
             Eigen::AngleAxisd(kQuarter, Eigen::Vector3d::UnitZ()).toRotationMatrix())
                .norm(),
            1e-12);
  // Seen from the hand, the base is where it should be.
  const auto from_hand = robot.baseFromLinks(robot.indexOf("hand").value());
  EXPECT_LT((from_hand[0].translation() - Eigen::Vector3d(-3, 1, -3)).norm(), 1e-12);
}

TEST(Urdf, JointsRestAtZeroOrInTheMiddleOfWhatTheyMay) {
  const std::string axis = "<axis xyz='1 0 0'/>";
  const Robot robot =
      parsed(link("base", visual(kBox)) + link("a") + link("b") + link("c") + link("d") +
             joint("a", "prismatic", "a", axis + "<limit lower='-1' upper='9' effort='1' velocity='1'/>") +
             joint("b", "prismatic", "b", axis + "<limit lower='2' upper='4' effort='1' velocity='1'/>") +
             joint("c", "prismatic", "c",
                   axis + "<limit lower='-9' upper='9' effort='1' velocity='1'/>" +
                       "<mimic joint='b' multiplier='2' offset='1'/>") +
             joint("d", "continuous", "d", axis));
  EXPECT_EQ(baseFrom(robot, "a").translation().x(), 0.0);
  EXPECT_EQ(baseFrom(robot, "b").translation().x(), 3.0);
  EXPECT_EQ(baseFrom(robot, "c").translation().x(), 7.0);
  EXPECT_TRUE(baseFrom(robot, "d").matrix().isIdentity());
}

TEST(Urdf, ShapesStandInTheFrameOfTheirLink) {
  const Robot robot =
      parsed(link("base", visual(kBox, "<origin xyz='10 0 0'/>") + visual("<sphere radius='1'/>")) +
             link("mast", visual("<cylinder radius='0.5' length='4'/>")) + joint("j", "fixed", "mast", ""));
  const Eigen::AlignedBox3f base = bounds(robot, "base");
  // Single precision.
  EXPECT_LT((base.min() - Eigen::Vector3f(-1, -2, -3)).norm(), 1e-6f);
  EXPECT_LT((base.max() - Eigen::Vector3f(11, 2, 3)).norm(), 1e-6f);
  const Eigen::AlignedBox3f mast = bounds(robot, "mast");
  EXPECT_LT((mast.max() - Eigen::Vector3f(0.5f, 0.5f, 2.0f)).norm(), 1e-6f);
  EXPECT_TRUE(robot.warnings.empty());
  // Collisions are not seen.
  const Robot bare =
      parsed(link("base", visual(kBox) + "<collision><geometry><box size='90 90 90'/></geometry>"
                                         "</collision>"));
  EXPECT_LT(bounds(bare, "base").max().norm(), 4.0f);
}

TEST(Urdf, WhatNobodySeesStopsNothing) {
  const std::string bare = "<inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1'/></inertial>";
  const std::string capsule = "<collision><geometry><capsule radius='1' length='2'/></geometry></collision>";
  const Robot robot = parsed(link("base", bare + visual(kBox) + capsule + capsule));
  EXPECT_LT(bounds(robot, "base").max().norm(), 4.0f);
  EXPECT_TRUE(robot.warnings.empty());
}

TEST(Urdf, UnknownElementsOfLinksWithAShapeAreNamed) {
  const std::string shape = "<geometry>" + kBox + "</geometry>";
  const auto warningsWith = [&](const std::string& more) {
    return parsed(link("base", visual(kBox) + more)).warnings;
  };
  const std::vector<std::string> warnings = warningsWith("\n<visul>" + shape + "</visul>");
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0],
            "1 elements of links have a <geometry>, but are unknown, and were left out: <visul> of "
            "some.urdf:4");
  const std::string checking = "self_collision_checking";
  for (const std::string& known :
       {"<" + checking + ">" + shape + "</" + checking + ">",
        "<drake:proxy xmlns:drake='d'>" + shape + "</drake:proxy>", std::string("<contact/><gravity/>")})
    EXPECT_TRUE(warningsWith(known).empty()) << known;
}

TEST(Urdf, LinksThatDoNotHangFromTheRootAreAnError) {
  const auto held = [](const std::string& name, const std::string& parent, const std::string& child) {
    return "<joint name='" + name + "' type='fixed'><parent link='" + parent + "'/><child link='" + child +
           "'/></joint>\n";
  };
  const std::string links = link("base", visual(kBox)) + link("arm") + link("hand", visual(kBox));
  const std::string ring = held("j", "arm", "hand") + held("k", "hand", "arm");
  EXPECT_EQ(errorOfText(robotText(links + ring)),
            "some.urdf:4: link arm: no joints lead to it from link base, the root, nor to link hand");
  EXPECT_EQ(errorOfText(robotText(links + ring + held("l", "base", "arm"))),
            "some.urdf:4: link arm: it is the child of joints k and l, but must be that of one");
}

TEST(Urdf, MaterialsThatAreNowhereAreOneLine) {
  const std::string grey = visual(kBox, "<material name='grey'/>");
  const Robot robot = parsed(link("base", grey) + link("a", grey) + joint("j", "fixed", "a", ""));
  ASSERT_EQ(robot.warnings.size(), 1u);
  EXPECT_EQ(robot.warnings[0].find("2 materials do not exist"), 0u) << robot.warnings[0];
}

class UrdfFile : public SceneFiles {
 protected:
  Robot loaded(const std::string& content, const SearchPath& search_path = {}) const {
    return loadRobot(write("robot/r.urdf", robotText(content)), search_path);
  }
  static std::string errorOfRobot(const std::string& file) {
    return messageOf<std::runtime_error>([&] { loadRobot(file, {}); });
  }
};

TEST_F(UrdfFile, MaterialsAreColoursOrTextures) {
  writeTexture("robot/paint.png");
  const Robot robot = loaded(
      "<material name='red'><color rgba='1 0 0.5 1'/></material>"
      "<material name='painted'><texture filename='paint.png'/></material>" +
      link("base", visual(kBox, "<material name='red'/>") + visual(kBox, "<material name='painted'/>") +
                       visual(kBox, "<material name='none'><color rgba='1 1 1 0'/></material>") +
                       visual(kBox, "<material name='ghost'><color rgba='1 1 1 0.36'/></material>") +
                       visual(kBox)));
  const std::vector<Mesh>& meshes = robot.links[0].meshes;
  ASSERT_EQ(meshes.size(), 4u);
  const auto material = [&](std::size_t mesh) {
    return robot.materials[static_cast<std::size_t>(meshes[mesh].material)];
  };
  EXPECT_EQ(material(0).base_color.value[0], 1.0f);
  EXPECT_NEAR(material(0).base_color.value[2], 0.214f, 0.001f);  // sRGB 0.5, IEC 61966-2-1
  ASSERT_EQ(material(1).base_texture, 0);
  EXPECT_EQ(robot.textures[0].width, 4);
  // A ray meets two faces of a box, of which 0.8² of what is behind is left.
  EXPECT_EQ(material(2).alpha_mode, AlphaMode::kBlend);
  EXPECT_NEAR(material(2).alpha, 0.2f, 1e-6f);
  EXPECT_EQ(material(3).base_texture, Material::kNoTexture);
  EXPECT_EQ(material(3).alpha_mode, AlphaMode::kOpaque);
  ASSERT_EQ(robot.warnings.size(), 1u);
  EXPECT_NE(
      robot.warnings[0].find("wholly transparent: " + pathOf("robot/r.urdf") + ":3: link base, visual 3"),
      std::string::npos)
      << robot.warnings[0];
}

TEST_F(UrdfFile, MeshesAreFoundBesideTheFileInPackagesAndByAddress) {
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  write("robot/beside.obj", triangle);
  write("elsewhere/description/meshes/part.obj", triangle);
  const std::string absolute = write("far/away.obj", triangle);
  SearchPath search_path;
  search_path.package_folder = [&](const std::string& package) {
    return package == "my_description" ? pathOf("elsewhere/description") : std::string();
  };
  const Robot robot = loaded(
      "<material name='red'><color rgba='1 0 0 1'/></material>" +
          link("base", visual("<mesh filename='beside.obj' scale='2 1 1'/>", "<material name='red'/>") +
                           visual("<mesh filename='package://my_description/meshes/part.obj'/>") +
                           visual("<mesh filename='file://" + absolute + "'/>")),
      search_path);
  ASSERT_EQ(robot.links[0].meshes.size(), 3u);
  EXPECT_EQ(boundsOf(robot.links[0].meshes[0]).max().x(), 2.0f);
  // A mesh without a material of its own gets that of the URDF.
  const auto material = static_cast<std::size_t>(robot.links[0].meshes[0].material);
  EXPECT_EQ(robot.materials[material].name, "red");
}

TEST_F(UrdfFile, AMissingMeshIsNamedWithItsLinkAndThePlaces) {
  const std::string file =
      write("r.urdf", robotText(link("base", visual("<mesh filename='package://robot/none.stl'/>"))));
  const std::string error = errorOfRobot(file);
  EXPECT_EQ(error.find(file + ":3: link base, visual 1: there is no mesh package://robot/none.stl"), 0u)
      << error;
  EXPECT_NE(error.find(pathOf("robot/none.stl")), std::string::npos) << error;
}

TEST_F(UrdfFile, WithNothingToSeeSaysWhy) {
  const std::string file =
      write("r.urdf", robotText(link("base", visual("<mesh filename='package://unknown/none.stl'/>"))));
  SearchPath lenient;
  lenient.missing = Missing::kWarn;
  const std::string error = messageOf<std::runtime_error>([&] { loadRobot(file, lenient); });
  EXPECT_EQ(error.find(file + ": there is nothing to see of this robot; "), 0u) << error;
  EXPECT_NE(error.find("package://unknown/none.stl"), std::string::npos) << error;
}

TEST_F(UrdfFile, APipeIsRefusedInsteadOfWaitedFor) {
  const std::string pipe = pathOf("p.urdf");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(errorOfRobot(pipe), pipe + ": this is a pipe or a device, and no file");
}

TEST(Urdf, WhatIsWrongIsNamedWithItsPlace) {
  EXPECT_EQ(errorOfText("<?xml version='1.0'?>\n<robot name='r'>\n<link name='a'>\n</robot>"),
            "some.urdf:4: the XML is broken here (Error reading end tag.)");
  EXPECT_EQ(errorOfText("<sdf/>"), "some.urdf:1: there is no <robot> element in this text");
  EXPECT_NE(errorOfText(robotText("<xacro:include filename='x'/>")).find("some.urdf:3: <xacro:include>"),
            std::string::npos);
  EXPECT_EQ(errorOfText(robotText(link("base", visual(kBox) + "\n<xacro:mast height='3'/>"))),
            "some.urdf:4: <xacro:mast> is a macro; turn this text into a URDF first, by xacro");
  const std::string no_parent = errorOfText(
      robotText(link("base", visual(kBox)) +
                "<joint name='j' type='fixed'><parent link='nowhere'/><child link='base'/></joint>"));
  EXPECT_EQ(no_parent.find("some.urdf:"), 0u) << no_parent;
  EXPECT_NE(no_parent.find("nowhere"), std::string::npos) << no_parent;
  const std::string flat = errorOfText(robotText(link("base", visual("<box size='1 0 1'/>"))));
  EXPECT_EQ(flat, "some.urdf:3: link base, visual 1: its box's side is 0, but must be above 0 m");
  const std::string word = errorOfText(robotText(link("base", visual("<box size='1 one 1'/>"))));
  EXPECT_EQ(word.find("some.urdf:3: this is no URDF: "), 0u) << word;
  EXPECT_NE(word.find("one"), std::string::npos) << word;
  EXPECT_EQ(word.find('\n'), std::string::npos) << word;
  EXPECT_EQ(errorOfText(robotText(link("base"))), "some.urdf: there is nothing to see of this robot");
  const std::string circle =
      errorOfText(robotText(link("base", visual(kBox)) + link("a") +
                            joint("a", "prismatic", "a",
                                  "<axis xyz='1 0 0'/><limit lower='0' upper='1' effort='1' velocity='1'/>"
                                  "<mimic joint='a'/>")));
  EXPECT_NE(circle.find("joint a: it mimics a, which mimics it"), std::string::npos) << circle;
}

TEST_F(UrdfFile, SdfModelsAreRobotsToo) {
  SKIP_WITHOUT_SDF();
  const std::string file =
      write("m.sdf",
            "<?xml version='1.0'?><sdf version='1.9'><model name='m'><pose>9 9 9 0 0 0</pose>"
            "<link name='body'><pose>0 0 1 0 0 0</pose><visual name='v'><pose>1 0 0 0 0 0</pose><geometry>"
            "<box><size>2 2 2</size></box></geometry></visual></link>"
            "<link name='head'><pose relative_to='body'>0 0 5 0 0 0</pose></link></model></sdf>");
  const Robot robot = loadRobot(file, {});
  ASSERT_EQ(robot.links.size(), 3u);
  EXPECT_EQ(robot.links[0].name, "m");
  EXPECT_EQ(baseFrom(robot, "body").translation(), Eigen::Vector3d(0, 0, 1));
  EXPECT_EQ(baseFrom(robot, "head").translation(), Eigen::Vector3d(0, 0, 6));
  EXPECT_EQ(bounds(robot, "body").max(), Eigen::Vector3f(2, 1, 1));

  const std::string world = write("w.sdf", "<?xml version='1.0'?><sdf version='1.9'><world name='w'/></sdf>");
  EXPECT_EQ(errorOfRobot(world), world + ": a robot is one <model>, and this is none");
  EXPECT_NE(errorOfRobot(pathOf("none.urdf")).find("there is no robot " + pathOf("none.urdf")),
            std::string::npos);
  EXPECT_NE(errorOfRobot(write("r.xacro", "")).find("xacro"), std::string::npos);
  EXPECT_NE(errorOfRobot(write("r.txt", "")).find("must end in"), std::string::npos);
}

#if SUNLIT_SDFORMAT_VERSION == 0
TEST_F(UrdfFile, RobotsOfSdfAreRefusedByWhatRobotsMayBeWhereNoneIsRead) {
  const std::string no_sdf =
      ": this build of sunlit reads no SDF, as libsdformat was not found when it was configured; it reads ";
  const std::string file = write("m.sdf", "<sdf version='1.9'/>");
  EXPECT_EQ(errorOfRobot(file), file + no_sdf + "robots that end in .urdf or .xml");
  EXPECT_EQ(errorOf(file), file + no_sdf + "worlds that end in .urdf, .dae, .gltf, .glb or .obj");
}
#endif

TEST_F(UrdfFile, ThatIsTooDeepOrTooFarIsRefused) {
  std::string deep = "<robot name='r'><link name='a'>";
  for (int i = 0; i < 100000; ++i) deep += "<a>";
  EXPECT_NE(errorOfRobot(write("deep.urdf", deep)).find("elements lie within each other on too many levels"),
            std::string::npos);
  const std::string far = errorOfText(robotText(link("base", visual(kBox)) + link("arm") +
                                                joint("j", "fixed", "arm", "<origin xyz='1e6 0 0'/>")));
  EXPECT_NE(far.find("joint j: its origin is not finite, or farther than 100 km away"), std::string::npos)
      << far;
}

TEST(Robot, BringsItsLooksIntoAScene) {
  Scene scene;
  scene.textures.resize(2);
  scene.materials.resize(3);
  Robot robot;
  robot.textures.resize(1);
  robot.materials.resize(2);
  robot.materials[1].base_texture = 0;
  robot.links.resize(2);
  robot.links[1].meshes.resize(1);
  robot.links[1].meshes[0].material = 1;
  const auto meshes = addLooks(robot, &scene);
  EXPECT_EQ(scene.materials.size(), 5u);
  EXPECT_EQ(scene.materials[3].base_texture, Material::kNoTexture);
  EXPECT_EQ(scene.materials[4].base_texture, 2);
  ASSERT_EQ(meshes.size(), 2u);
  EXPECT_EQ(meshes[1].at(0).material, 4);
}

TEST(Rover, StandsOnItsWheelsWithTheCameraAMetreUp) {
  const Robot rover = loadRobot(SUNLIT_SOURCE_DIR "/worlds/robots/rover/rover.urdf", {});
  if (SUNLIT_SDFORMAT_VERSION > 0) {  // else its headlights, elements of Gazebo's, are named
    EXPECT_TRUE(rover.warnings.empty()) << rover.warnings[0];
  }
  EXPECT_EQ(rover.links[0].name, "base_link");
  EXPECT_LT(rover.triangleCount(), 50000u);
  const Eigen::Vector3d camera = baseFrom(rover, "camera_link").translation();
  EXPECT_NEAR(camera.z(), 1.0, 1e-9);
  EXPECT_EQ(camera.y(), 0.0);
  const std::vector<Eigen::Isometry3d> places = rover.baseFromLinks(0);
  for (std::size_t i = 0; i < rover.links.size(); ++i) {
    double lowest = 1e9;
    for (const Mesh& mesh : rover.links[i].meshes) {
      EXPECT_GT(volumeOf(mesh), 0.0) << mesh.name << " is inside out";
      for (const Eigen::Vector3f& position : mesh.positions)
        lowest = std::min(lowest, (places[i] * position.cast<double>()).z());
    }
    // The lugs of the tyres are flat: between two of them a wheel is lower than its radius by 3 mm at most.
    const bool wheel = rover.links[i].name.rfind("wheel", 0) == 0;
    if (wheel) {
      EXPECT_NEAR(lowest, 0.0, 0.004) << rover.links[i].name;
    } else {
      EXPECT_GT(lowest, 0.05) << rover.links[i].name;
    }
    // Nothing stands before the lens: 60° across, 47° high; what may be seen is the lidar far below the
    // middle.
    for (const Mesh& mesh : rover.links[i].meshes) {
      for (const Eigen::Vector3f& position : mesh.positions) {
        const Eigen::Vector3d seen = places[i] * position.cast<double>() - camera;
        if (seen.x() <= 0.0) continue;
        EXPECT_LT(seen.z(), -0.35 * seen.x()) << mesh.name;
      }
    }
  }
}

}  // namespace
}  // namespace sunlit::scene
