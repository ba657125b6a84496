// Files whose content Git LFS has not brought yet are missing, and said to be.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "unit/scene/scene_files.h"
#include "unit/scene/sdf_texts.h"

namespace sunlit::scene {
namespace {

const std::string kPointer =
    "version https://git-lfs.github.com/spec/v1\n"
    "oid sha256:4d7a214614ab2935c943f9e0ff69d22eadbb8f32b1258daaa5e2ca24d17e2393\nsize 12345\n";
const std::string kDrawTheOthers =
    "; --missing warn (of launch files missing:=warn, of nodes missing: warn) draws the rest";

class GitLfs : public SceneFiles {
 protected:
  /// The error or the example of a pointer of that name.
  std::string saysOf(const std::string& name) const {
    return pathOf(name) +
           ": this is a Git LFS pointer, and not the file itself: run `git lfs pull` in its folder";
  }
  /// A model of a box and of what has that geometry and material.
  std::string worldWith(const std::string& geometry, const std::string& material = "") const {
    return write("w.world",
                 world("<model name='m'><link name='l'>" + boxVisual() + "<visual name='x'><geometry>" +
                       geometry + "</geometry>" + material + "</visual></link></model>"));
  }
  static Scene lenient(const std::string& file) {
    SearchPath search_path;
    search_path.missing = Missing::kWarn;
    return load(file, search_path);
  }
  static void expectWarning(const Scene& scene, const std::string& line) {
    EXPECT_EQ(std::count(scene.warnings.begin(), scene.warnings.end(), line), 1)
        << line << " is not in " << ::testing::PrintToString(scene.warnings);
  }
};

TEST_F(GitLfs, AMeshOfAnyFormatIsMissing) {
  for (const char* ending : {"dae", "obj", "stl", "ply", "gltf", "glb", "DAE"}) {
    const std::string name = std::string("p.") + ending;
    write(name, kPointer);
    const std::string file = worldWith("<mesh><uri>" + name + "</uri></mesh>");
    EXPECT_EQ(errorOf(file), saysOf(name) + kDrawTheOthers);
    const Scene scene = lenient(file);
    EXPECT_EQ(scene.triangleCount(), 12u);
    expectWarning(scene, "1 meshes are missing and were left out: " + saysOf(name));
  }
}

TEST_F(GitLfs, SoIsWhatAMeshNeedsOfOtherFiles) {
  write("p.mtl", kPointer);
  write("t.obj", "mtllib p.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::string of_library = pathOf("t.obj") + ": its library " + saysOf("p.mtl");
  EXPECT_EQ(errorOf(pathOf("t.obj")), of_library);
  expectWarning(lenient(worldWith("<mesh><uri>t.obj</uri></mesh>")),
                "1 meshes are missing and were left out: " + of_library);
  write("p.bin", kPointer);
  write("t.gltf", R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":36,"uri":"p.bin"}]})");
  expectWarning(lenient(worldWith("<mesh><uri>t.gltf</uri></mesh>")),
                "1 meshes are missing and were left out: " + pathOf("t.gltf") + ": " + saysOf("p.bin"));
}

TEST_F(GitLfs, AWorldOfAnyFormatIsAnError) {
  for (const char* name : {"p.world", "p.sdf", "p.urdf", "p.dae", "p.gltf", "p.glb", "p.obj"})
    EXPECT_EQ(errorOf(write(name, kPointer)), saysOf(name));
}

TEST_F(GitLfs, AModelIsMissing) {
  write("models/p/model.sdf", kPointer);
  const std::string include = "<include><uri>model://p</uri></include>";
  const std::string file =
      write("w.world", world(include + "<model name='m'><link name='l'>" + boxVisual() + "</link></model>"));
  EXPECT_EQ(errorOf(file), saysOf("models/p/model.sdf") + kDrawTheOthers);
  const Scene scene = lenient(file);
  EXPECT_EQ(scene.triangleCount(), 12u);
  expectWarning(scene, "1 models are missing and were left out: " + saysOf("models/p/model.sdf"));
}

TEST_F(GitLfs, ATextureIsMissing) {
  write("p.png", kPointer);
  write("t.mtl", "newmtl a\nmap_Kd p.png\n");
  write("t.obj", "mtllib t.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const Scene scene = load(worldWith("<mesh><uri>t.obj</uri></mesh>"), {});
  expectWarning(scene, "1 textures are missing, neutral ones take their place: " + saysOf("p.png"));
}

TEST_F(GitLfs, AScriptIsMissing) {
  write("p.material", kPointer);
  const Scene scene =
      load(worldWith("<sphere><radius>1</radius></sphere>",
                     "<material><script><uri>p.material</uri><name>My/Wall</name></script></material>"),
           {});
  expectWarning(scene, "1 material scripts are missing: " + saysOf("p.material"));
}

TEST_F(GitLfs, AHeightMapAndItsLayersAreMissing) {
  write("p.png", kPointer);
  const std::string map = worldWith("<heightmap><uri>p.png</uri><size>8 8 1</size></heightmap>");
  EXPECT_EQ(errorOf(map), saysOf("p.png") + kDrawTheOthers);
  expectWarning(lenient(map),
                "1 height maps are missing or cannot be read and were left out: " + saysOf("p.png"));
  writeTexture("heights.png");
  const std::string layer = "<texture><diffuse>p.png</diffuse><normal>n.png</normal><size>1</size></texture>";
  const Scene bare = load(
      worldWith("<heightmap><uri>heights.png</uri><size>8 8 1</size>" + layer + layer + "</heightmap>"), {});
  expectWarning(bare, "1 textures are missing, neutral ones take their place: " + saysOf("p.png"));
}

}  // namespace
}  // namespace sunlit::scene
