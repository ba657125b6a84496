// OSMesa, EGL and our own rasterizer see the same triangles, each of them the test of the others.
#include <random>
#include <set>

#include "rasterizer_scenes.h"
#include "sunlit/image/exposure.h"
#include "sunlit/light/bodies.h"
#include "sunlit/path/path.h"
#include "sunlit/scene/load.h"
#include "sunlit/scene/race_track.h"
#include "support/compare_pictures.h"
#include "support/needs.h"

namespace sunlit::test {
namespace {

const std::string kAws = SUNLIT_SHARED_DIR "/worlds/aws_racetrack";
const std::string kForza = SUNLIT_SHARED_DIR "/worlds/forza";

/// Samples on an edge to within rounding, or of two surfaces that lie in each other.
constexpr double kOpaqueShare = 1e-4;
/// Between the texels of cut-outs, and where our own chooses their size for eight samples together.
constexpr double kMaskedShare = 1e-3, kCoverage = 1e-3;
/// Depth is 1 / the triangle's plane, evaluated from another sample of the row in single precision. Planes
/// seen from the side lose digits.
constexpr double kDepth = 1e-4;

constexpr std::size_t kPoses = 6;

std::vector<Eigen::Isometry3d> posesOf(const std::vector<Eigen::Vector3d>& waypoints) {
  const auto path = path::posesAlong(waypoints, {1.0, 1.0});
  std::vector<Eigen::Isometry3d> poses;
  for (std::size_t i = 0; i < kPoses; ++i)
    poses.push_back(path[i * path.size() / kPoses] * linkFromOptical());
  return poses;
}

/// A world as it is, and as it would be without cut-outs.
struct WithAndWithoutMasks {
  explicit WithAndWithoutMasks(scene::Scene scene) : masked(std::make_shared<const Drawable>(scene)) {
    makeOpaque(&scene);
    opaque = std::make_shared<const Drawable>(std::move(scene));
  }

  std::shared_ptr<const Drawable> masked, opaque;
};

class Worlds : public EachRasterizer {
 protected:
  /// The last one is kept: the cases ask for each once a rasterizer.
  static const WithAndWithoutMasks& loaded(const std::string& world) {
    if (name_ != world) {
      last_.reset();
      last_ = std::make_unique<const WithAndWithoutMasks>(scene::load(world, {}));
      name_ = world;
    }
    return *last_;
  }
  static void TearDownTestSuite() {
    last_.reset();
    name_.clear();
  }

  void expectAgreement(const std::string& world, const std::vector<Eigen::Vector3d>& waypoints) const {
    const std::vector<Eigen::Isometry3d> poses = posesOf(waypoints);
    Disagreement masked, opaque;
    {
      SideBySide both(loaded(world).masked, GetParam());
      for (const Eigen::Isometry3d& pose : poses) both.compare(viewFrom(pose), &masked);
    }
    SideBySide both(loaded(world).opaque, GetParam());
    for (const Eigen::Isometry3d& pose : poses) both.compare(viewFrom(pose), &opaque);
    EXPECT_LE(opaque.idShare(), kOpaqueShare);
    EXPECT_LE(opaque.largest_depth, kDepth);
    EXPECT_LE(masked.idShare(), kMaskedShare);
    EXPECT_LE(masked.largest_depth, kDepth);
    if (masked.masked_by_builtin > 0) {
      EXPECT_NEAR(masked.coverage(), 0.0, kCoverage);
    }
    RecordProperty("opaque", std::to_string(opaque.idShare()));
    RecordProperty("masked", std::to_string(masked.idShare()));
  }

 private:
  inline static std::string name_;
  inline static std::unique_ptr<const WithAndWithoutMasks> last_;
};

TEST_P(Worlds, BuiltInIsSeenAlike) {
  expectAgreement(scene::kRaceTrack, scene::raceTrackWaypoints());
}

TEST_P(Worlds, DevelopedPicturesAreAlike) {
  const auto scene = loaded(scene::kRaceTrack).masked->geometry->scene;
  const Eigen::Isometry3d pose = posesOf(scene::raceTrackWaypoints())[2];
  const sky::Daylight day = daylightAt(150.0, 35.0);
  const auto picture = [&](render::RasterizerKind rasterizer) {
    render::RenderOptions options = smallCamera(320, 240);
    options.rasterizer = rasterizer;
    render::Renderer renderer(scene, options);
    renderer.look(pose);
    return image::develop(renderer.light(day), 13.0);
  };
  const PictureDifference difference =
      differenceOf(picture(GetParam()), picture(render::RasterizerKind::kBuiltin));
  EXPECT_LT(difference.mean, 0.1);
}

TEST_P(Worlds, AwsRaceTrackIsSeenAlike) {
  SKIP_WITHOUT_SDF();
  SKIP_WITHOUT(kAws);
  expectAgreement(kAws + "/worlds/racetrack_day.world",
                  path::readWaypoints(SUNLIT_SOURCE_DIR "/config/paths/aws_racetrack.csv"));
}

TEST_P(Worlds, ForzaIsSeenAlike) {
  SKIP_WITHOUT(kForza);
  expectAgreement(kForza + "/forza.glb", path::readWaypoints(kForza + "/waypoints.csv"));
}
SUNLIT_INSTANTIATE_FOR_OTHERS(Worlds);

class Scenes : public EachRasterizer {};

/// Blocks over some hundred metres about `origin`, some of them cut out.
scene::Scene town(const Eigen::Vector3f& origin) {
  scene::Scene scene;
  std::minstd_rand random(1);
  const auto uniform = [&random] {
    return static_cast<float>(random()) / static_cast<float>(std::minstd_rand::max());
  };
  scene::Texture texture{"leaves", 64, 64, {}};
  for (int i = 0; i < 4 * 64 * 64; ++i)
    texture.rgba.own().push_back(static_cast<std::uint8_t>(255.0f * uniform()));
  scene.textures.push_back(texture);
  const int plain = addMaterial(&scene, {0.4f, 0.3f, 0.2f}), leaves = addMaterial(&scene, {0.8f, 0.9f, 0.8f});
  scene.materials[1].base_texture = 0;
  scene.materials[1].alpha_mode = scene::AlphaMode::kMask;
  addGround(&scene, plain, 5000.0f);
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3f low(300.0f * uniform() - 150.0f, 300.0f * uniform() - 150.0f, 0.0f);
    const Eigen::Vector3f size(1.0f + 5.0f * uniform(), 1.0f + 5.0f * uniform(), 1.0f + 9.0f * uniform());
    addBlock(&scene, i % 3 == 0 ? leaves : plain, origin + low, size);
  }
  return scene;
}

TEST_P(Scenes, FarFromTheOriginAreSeenAlike) {
  const Eigen::Vector3d origin(3600.0, -1200.0, 0.0);
  SideBySide both(town(origin.cast<float>()), GetParam());
  Disagreement sum;
  for (const double north : {-90.0, -20.0, 60.0}) {
    both.compare(viewFrom(lookingAt(origin + Eigen::Vector3d(-100.0, north, 3.0), origin)), &sum);
  }
  EXPECT_LE(sum.idShare(), kMaskedShare);
  EXPECT_LE(sum.largest_depth, kDepth);
}

TEST_P(Scenes, WiderThanOnePassAreSeenAlike) {
  SideBySide both(town({0.0f, 0.0f, 0.0f}), GetParam());
  Disagreement sum;
  both.compare(viewFrom(lookingAt({-100.0, 20.0, 3.0}, {0.0, 0.0, 2.0}), 8192, 100, 100.0), &sum);
  EXPECT_EQ(sum.samples, 16384u * 200u);
  EXPECT_LE(sum.idShare(), kMaskedShare);
}

TEST_P(Scenes, WithARobotThatCarriesTheCameraAreSeenAlike) {
  scene::Scene scene = town({0.0f, 0.0f, 0.0f});
  scene::Scene links = scene;
  links.meshes.clear();
  // Not as far beside the camera as below: its edges would run through the middles of samples, in which the
  // sheet that turns away there is as near as the one that is seen.
  addBlock(&links, 0, {-0.3f, -0.31f, -0.6f}, {2.0f, 0.64f, 0.3f});
  addBlock(&links, 1, {0.5f, -1.0f, -0.3f}, {0.1f, 2.0f, 1.0f});
  const light::World world(shared(std::move(scene)), {links.meshes});
  const render::TexturePyramids pyramids(*world.geometry->scene);
  const render::RasterizerWorld all{world.geometry, pyramids, 0.0};
  const auto tested = render::makeRasterizer(GetParam(), all),
             builtin = render::makeRasterizer(render::RasterizerKind::kBuiltin, all);
  for (const double north : {-30.0, 0.0, 30.0}) {
    Eigen::Isometry3d map_from_base(Eigen::Translation3d(-60.0, north, 1.5));
    const auto bodies = world.bodies->placed({map_from_base});
    const render::View view = viewFrom(map_from_base * linkFromOptical(), 320, 240, 90.0);
    std::vector<render::Sample> samples, expected;
    tested->draw(view, bodies.get(), &samples);
    builtin->draw(view, bodies.get(), &expected);
    std::size_t differing = 0, of_robot = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      differing += samples[i].triangle != expected[i].triangle;
      of_robot += samples[i].triangle > world.geometry->triangles.size();
    }
    EXPECT_LE(static_cast<double>(differing), kMaskedShare * static_cast<double>(samples.size()));
    EXPECT_GT(of_robot, samples.size() / 20);
  }
}

SUNLIT_INSTANTIATE_FOR_OTHERS(Scenes);

/// Of which it is known what is seen: our own is tested by that, too.
class Surfaces : public EachRasterizer {};

TEST_P(Surfaces, OneSidedSheetsAreSeenFromTheirFrontOnly) {
  scene::Scene scene;
  const int one = addMaterial(&scene, {0.5f, 0.5f, 0.5f}), both = addMaterial(&scene, {0.5f, 0.5f, 0.5f});
  scene.materials[static_cast<std::size_t>(one)].double_sided = false;
  scene.materials[static_cast<std::size_t>(both)].double_sided = true;
  addPatch(&scene, one, {5.0f, 1.0f, 0.0f}, {0.0f, 2.0f, 0.0f}, {0.0f, 0.0f, 2.0f});  // faces east
  addPatch(&scene, both, {5.0f, -3.0f, 0.0f}, {0.0f, 2.0f, 0.0f}, {0.0f, 0.0f, 2.0f});
  SideBySide side(scene, GetParam());
  Disagreement sum;
  const auto seen = [&] {
    std::set<std::uint32_t> triangles;
    for (const render::Sample& sample : side.samples()) triangles.insert(sample.triangle);
    return triangles;
  };
  side.compare(viewFrom(lookingAt({0.0, 0.0, 1.0}, {5.0, 0.0, 1.0}), 160, 120, 90.0), &sum);
  EXPECT_EQ(seen().size(), 3u) << "sky, and the two triangles that have no back";
  side.compare(viewFrom(lookingAt({10.0, 0.0, 1.0}, {5.0, 0.0, 1.0}), 160, 120, 90.0), &sum);
  EXPECT_EQ(seen().size(), 5u);
  EXPECT_EQ(sum.ids, 0u);
}

TEST_P(Surfaces, AreCutAtTheNearPlane) {
  scene::Scene scene;
  addGround(&scene, addMaterial(&scene, {0.5f, 0.5f, 0.5f}), 1000.0f);
  SideBySide both(scene, GetParam());
  Disagreement sum;
  // Straight ahead at eye height 1 m, 90° up and down: the lowest row sees the ground 1 m ahead.
  for (const double near_m : {0.05, 0.9, 1.5, 40.0}) {
    render::View view = viewFrom(lookingAt({0.0, 0.0, 1.0}, {1.0, 0.0, 1.0}), 120, 120, 90.0);
    view.near_m = near_m;
    both.compare(view, &sum);
    double nearest = 1e9;
    for (const render::Sample& sample : both.samples())
      nearest = std::min(nearest, static_cast<double>(sample.depth));
    EXPECT_GE(nearest, near_m * (1.0 - 1e-6));
    EXPECT_LE(nearest, std::max(near_m, 1.0) * 1.3) << "rows are up to a quarter of the depth apart at 40 m";
  }
  EXPECT_LE(sum.idShare(), kOpaqueShare);
  EXPECT_LE(sum.largest_depth, kDepth);
}

/// A ball of 2 m about the origin, of triangles down to a small part of a sample.
scene::Scene ball(int rings) {
  scene::Scene scene;
  scene::Mesh mesh;
  mesh.material = addMaterial(&scene, {0.5f, 0.5f, 0.5f});
  scene.materials[0].double_sided = true;
  const int across = 2 * rings;
  for (int i = 0; i <= rings; ++i) {
    for (int j = 0; j < across; ++j) {
      const double polar = kPi * i / rings, around = 2.0 * kPi * j / across;
      const Eigen::Vector3d towards(std::sin(polar) * std::cos(around), std::sin(polar) * std::sin(around),
                                    std::cos(polar));
      mesh.positions.push_back((2.0 * towards).cast<float>());
      mesh.normals.push_back(-towards.cast<float>());
      mesh.texture_coordinates.push_back({0.0f, 0.0f});
    }
  }
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(i * across + j % across); };
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < across; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  scene.meshes.push_back(std::move(mesh));
  return scene;
}

TEST_P(Surfaces, NoSkyIsSeenFromWithinAClosedMesh) {
  for (const int rings : {3, 40, 400}) {
    SideBySide both(ball(rings), GetParam());
    for (const double y : {-0.7, 0.0, 0.7}) {
      Disagreement sum;
      both.compare(viewFrom(lookingAt({0.1, y, 0.2}, {-1.0, 0.3, 2.0}), 320, 240, 100.0), &sum);
      std::size_t sky = 0;
      for (const render::Sample& sample : both.samples()) sky += sample.sky();
      EXPECT_EQ(sky, 0u) << rings << " rings, from " << y;
      EXPECT_LE(sum.idShare(), kOpaqueShare) << rings << " rings, from " << y;
    }
  }
}
SUNLIT_INSTANTIATE_FOR_ALL(Surfaces);

}  // namespace
}  // namespace sunlit::test
