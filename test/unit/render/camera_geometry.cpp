// Depth, pose and camera model agree; pixels are where the camera says; textures and faces are the right way
// round.
#include <gtest/gtest.h>

#include "support/message_of.h"
#include "test_scenes.h"

namespace sunlit::test {
namespace {

/// Hills of 64 × 64 patches far from the origin of `map`, where single precision is a quarter of a
/// millimetre.
scene::Scene hills(const Eigen::Vector3f& centre) {
  scene::Scene scene;
  const int material = addMaterial(&scene, Eigen::Array3f(0.5f, 0.5f, 0.5f));
  scene::Mesh mesh;
  mesh.name = "hills";
  mesh.material = material;
  constexpr int kSide = 65;
  for (int j = 0; j < kSide; ++j) {
    for (int i = 0; i < kSide; ++i) {
      const float x = static_cast<float>(i - kSide / 2), y = static_cast<float>(j - kSide / 2);
      mesh.positions.push_back(centre +
                               Eigen::Vector3f(x, y, 0.8f * std::sin(0.5f * x) * std::cos(0.4f * y)));
      mesh.normals.push_back(Eigen::Vector3f::UnitZ());
    }
  }
  for (std::uint32_t j = 0; j + 1 < kSide; ++j) {
    for (std::uint32_t i = 0; i + 1 < kSide; ++i) {
      const std::uint32_t a = j * kSide + i;
      mesh.triangles.push_back({a, a + 1, a + kSide + 1});
      mesh.triangles.push_back({a, a + kSide + 1, a + kSide});
    }
  }
  scene.meshes.push_back(mesh);
  return scene;
}

/// Depth at which the pixel's ray meets the mesh first, by brute force in double precision; infinite for
/// none.
double trueDepth(const scene::Mesh& mesh, const Eigen::Vector3d& eye, const Eigen::Vector3d& ray) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& t : mesh.triangles) {
    Eigen::Matrix3d system;
    const Eigen::Vector3d a = mesh.positions[t[0]].cast<double>();
    system.col(0) = mesh.positions[t[1]].cast<double>() - a;
    system.col(1) = mesh.positions[t[2]].cast<double>() - a;
    system.col(2) = -ray;
    const Eigen::Vector3d uvz = system.inverse() * (eye - a);
    if (uvz.x() < 0 || uvz.y() < 0 || uvz.x() + uvz.y() > 1 || uvz.z() <= 0) continue;
    nearest = std::min(nearest, uvz.z());
  }
  return nearest;
}

class Depth : public testing::TestWithParam<int> {};

TEST_P(Depth, ReprojectsIntoAnotherViewWithinATwentiethOfAPixel) {
  const Eigen::Vector3f centre(2000.0f, -3000.0f, 50.0f);
  const scene::Scene scene = hills(centre);
  render::RenderOptions options = smallCamera(96, 64, 70.0);
  options.supersampling = GetParam();
  render::Renderer renderer(shared(scene), options);
  const Eigen::Vector3d eye = centre.cast<double>() + Eigen::Vector3d(-20.0, 3.0, 4.0);
  const Eigen::Isometry3d map_from_optical = lookingAt(eye, eye + Eigen::Vector3d(1.0, -0.1, -0.25));
  renderer.look(map_from_optical);
  const image::DepthImage depth = renderer.depth();
  // The second camera is 2 m to the side.
  const Eigen::Isometry3d map_from_second = map_from_optical * Eigen::Translation3d(2.0, 0.0, 0.0);

  const image::PinholeCamera& camera = options.camera;
  int compared = 0, off = 0;
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const Eigen::Vector3d ray = camera.unproject({static_cast<double>(x), static_cast<double>(y)});
      const double truth = trueDepth(scene.meshes[0], eye, map_from_optical.linear() * ray);
      if (!std::isfinite(truth)) continue;
      ++compared;
      const auto reprojected = [&](double z) {
        return camera.project(map_from_second.inverse() * (map_from_optical * (z * ray)));
      };
      const double z = *depth.at(x, y);
      if (!std::isfinite(z) || (reprojected(z) - reprojected(truth)).norm() > 0.05) ++off;
    }
  }
  ASSERT_GT(compared, 3000);
  // Where a ridge hides what is behind it, the centre of a pixel may see what none of its samples sees.
  EXPECT_LE(off, compared / 200) << "of " << compared;
}
INSTANTIATE_TEST_SUITE_P(Supersampling, Depth, testing::Values(1, 2, 3));

TEST(Depth, IsNotANumberForSky) {
  scene::Scene scene;
  addPatch(&scene, addMaterial(&scene, Eigen::Array3f::Ones()), {10.0f, -50.0f, -50.0f}, {0.0f, 100.0f, 0.0f},
           {0.0f, 0.0f, 50.0f});
  render::Renderer renderer(shared(scene), smallCamera());
  renderer.look(lookingAt({0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}));
  const image::DepthImage depth = renderer.depth();
  EXPECT_TRUE(std::isnan(*depth.at(80, 10)));
  EXPECT_NEAR(*depth.at(80, 110), 10.0f, 1e-5f);  // single precision of 10 m
}

TEST(Depth, ReachesFromCentimetresToTheHorizon) {
  scene::Scene scene;
  const int material = addMaterial(&scene, Eigen::Array3f::Ones());
  addPatch(&scene, material, {0.06f, 0.0f, -1.0f}, {0.0f, 1.0f, 0.0f},
           {0.0f, 0.0f, 2.0f});  // left half, at 6 cm
  addPatch(&scene, material, {15000.0f, -9e4f, -9e4f}, {0.0f, 1.8e5f, 0.0f}, {0.0f, 0.0f, 1.8e5f});
  addPatch(&scene, material, {15001.0f, -9e4f, -9e4f}, {0.0f, 1.8e5f, 0.0f},
           {0.0f, 0.0f, 1.8e5f});  // 1 m behind
  render::Renderer renderer(shared(scene), smallCamera());
  renderer.look(lookingAt({0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}));
  const image::DepthImage depth = renderer.depth();
  EXPECT_NEAR(*depth.at(20, 60), 0.06f, 1e-7f);
  EXPECT_NEAR(*depth.at(140, 60), 15000.0f, 0.01f);
}

TEST(Depth, EndsWhereThePictureEnds) {
  scene::Scene scene;
  addGround(&scene, addMaterial(&scene, {0.5f, 0.5f, 0.5f}), 500.0f);
  const auto ground = shared(scene);
  // A row of pixels there is 8 m of ground: some end between its samples and their middle.
  for (double far_m = 50.0; far_m < 58.0; far_m += 1.0) {
    render::RenderOptions options;
    options.camera = image::PinholeCamera::fromFieldOfView(160, 120, Angle::degrees(60.0));
    options.far_m = far_m;
    render::Renderer renderer(ground, options);
    renderer.look(lookingAt({0.0, 0.0, 2.0}, {50.0, 3.0, 0.0}));
    float farthest = 0.0f;
    for (const float depth : renderer.depth().data) {
      if (depth > farthest) farthest = depth;
    }
    EXPECT_LE(farthest, static_cast<float>(far_m));
    EXPECT_GT(farthest, static_cast<float>(far_m) - 12.0f);
  }
}

TEST(Pixel, CentreIsWhereTheCameraModelSaysIt) {
  // A small square whose projection covers exactly pixels 100 … 103 × 40 … 42, edges half a pixel beyond the
  // centres.
  render::RenderOptions options = smallCamera(160, 120, 60.0);
  options.supersampling = 2;
  options.camera.cx += 3.25;  // off-centre, so that mirrored or shifted conventions show
  options.camera.cy -= 7.5;
  options.camera.fy *= 1.1;
  const Eigen::Isometry3d map_from_optical = lookingAt({1.0, 2.0, 3.0}, {5.0, 4.0, 2.0});
  const auto corner = [&](double u, double v) {
    return Eigen::Vector3f((map_from_optical * (8.0 * options.camera.unproject({u, v}))).cast<float>());
  };
  scene::Scene scene;
  const Eigen::Vector3f origin = corner(99.5, 39.5);
  addPatch(&scene, addMaterial(&scene, Eigen::Array3f::Ones()), origin, corner(103.5, 39.5) - origin,
           corner(99.5, 42.5) - origin);
  render::Renderer renderer(shared(scene), options);
  renderer.look(map_from_optical);
  const image::DepthImage depth = renderer.depth();
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 160; ++x) {
      const bool inside = x >= 100 && x <= 103 && y >= 40 && y <= 42;
      EXPECT_EQ(std::isfinite(*depth.at(x, y)), inside) << x << ", " << y;
    }
  }
}

/// 2 × 2 texels: red green / blue white.
scene::Texture fourColors() {
  return {"four colours", 2, 2, {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 255}};
}

TEST(Texture, OriginIsItsTopLeftCornerAndItIsNotMirrored) {
  scene::Scene scene;
  scene.textures.push_back(fourColors());
  const int material = addMaterial(&scene, Eigen::Array3f::Ones());
  scene.materials[0].base_texture = 0;
  // A poster to the north, seen from the south: s runs east (right), t runs down.
  addPatch(&scene, material, {-1.0f, 5.0f, 1.0f}, {2.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -2.0f});
  render::Renderer renderer(shared(scene), smallCamera());
  renderer.look(lookingAt({0.0, 0.0, 0.0}, {0.0, 5.0, 0.0}));
  const image::LinearImage image = renderer.light(daylightAt(180.0, 30.0));
  // 1 m at 5 m is 27.7 px; texel centres lie half of that from the middle, where bilinear filtering leaves
  // them pure.
  const Eigen::Array3f red = at(image, 66, 46), green = at(image, 93, 46), blue = at(image, 66, 73),
                       white = at(image, 93, 73);
  EXPECT_GT(red[0], 5.0f * red[1]);
  EXPECT_GT(red[0], 5.0f * red[2]);
  EXPECT_GT(green[1], 5.0f * green[0]);
  EXPECT_GT(blue[2], 5.0f * blue[0]);
  EXPECT_LT(white.maxCoeff(), 2.0f * white.minCoeff());
}

TEST(Face, SeenFromBehindIsInvisibleUnlessDoubleSided) {
  for (const bool double_sided : {false, true}) {
    scene::Scene scene;
    const int material = addMaterial(&scene, Eigen::Array3f::Ones());
    scene.materials[0].double_sided = double_sided;
    addPatch(&scene, material, {-1.0f, 5.0f, -1.0f}, {2.0f, 0.0f, 0.0f},
             {0.0f, 0.0f, 2.0f});  // front to the south
    render::Renderer renderer(shared(scene), smallCamera());
    renderer.look(lookingAt({0.0, 0.0, 0.0}, {0.0, 5.0, 0.0}));
    EXPECT_TRUE(std::isfinite(*renderer.depth().at(80, 60)));
    renderer.look(lookingAt({0.0, 10.0, 0.0}, {0.0, 5.0, 0.0}));
    EXPECT_EQ(std::isfinite(*renderer.depth().at(80, 60)), double_sided);
  }
}

TEST(Face, WithNormalsTheWrongWayRoundIsLitAllTheSame) {
  scene::Scene scene;
  const int material = addMaterial(&scene, Eigen::Array3f(0.5f, 0.5f, 0.5f));
  addGround(&scene, material, 50.0f);
  scene::Scene flipped = scene, missing = scene;
  for (auto& normal : flipped.meshes[0].normals) normal = -normal;
  for (auto& normal : missing.meshes[0].normals) normal.setZero();
  const sky::Daylight day = daylightAt(140.0, 40.0);
  std::vector<float> seen;
  for (const scene::Scene& s : {scene, flipped, missing}) {
    render::Renderer renderer(shared(s), smallCamera());
    renderer.look(lookingAt({0.0, 0.0, 5.0}, {0.0, 0.0, 0.0}));
    seen.push_back(at(renderer.light(day), 80, 60)[1]);
  }
  // Packing a normal costs 3e-5 of it.
  EXPECT_NEAR(seen[1], seen[0], 1e-4f * seen[0]);
  EXPECT_NEAR(seen[2], seen[0], 1e-4f * seen[0]);
}

TEST(Renderer, RejectsBadOptionsByName) {
  render::RenderOptions options = smallCamera();
  options.supersampling = 5;
  EXPECT_EQ(messageOf([&] { render::validate(options); }), "supersampling is 5, but must be from 1 to 4");
  options = smallCamera();
  options.near_m = std::nan("");
  EXPECT_THROW(render::validate(options), std::invalid_argument);
  options = smallCamera(8, 120);
  EXPECT_THROW(render::validate(options), std::invalid_argument);
  options = smallCamera();
  options.final_gather = 17;
  EXPECT_EQ(messageOf([&] { render::validate(options); }), "final_gather is 17, but must be from 0 to 16");
}

TEST(Renderer, NeedsALookBeforeLight) {
  scene::Scene scene;
  addGround(&scene, addMaterial(&scene, Eigen::Array3f::Ones()), 5.0f);
  const render::Renderer renderer(shared(scene), smallCamera());
  EXPECT_THROW(renderer.light(daylightAt(0.0, 10.0)), std::logic_error);
  EXPECT_THROW(renderer.depth(), std::logic_error);
}

TEST(Renderer, SeesOnlySkyInAnEmptyScene) {
  scene::Scene scene;
  scene.name = "nothing";
  render::Renderer renderer(shared(scene), smallCamera());
  const Eigen::Isometry3d pose = lookingAt({0.0, 0.0, 1.0}, {1.0, 0.0, 1.5});
  renderer.look(pose);
  const sky::Daylight day = daylightAt(200.0, 30.0);
  const image::LinearImage image = renderer.light(day);
  const Eigen::Vector3d ray = pose.linear() * renderer.options().camera.unproject({20.0, 30.0});
  const Eigen::Array3f sky = day.skyLuminance(ray.normalized().cast<float>()).value;
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(at(image, 20, 30)[c], sky[c], 1e-3f * sky[c]);  // direction in single precision
}

TEST(SunDisc, InViewGivesTheEyeTheSunsIlluminance) {
  scene::Scene scene;
  scene.name = "nothing";
  render::RenderOptions options = smallCamera(64, 64, 4.0);  // the disc is 8.5 px across
  render::Renderer renderer(shared(scene), options);
  const sky::Daylight day = daylightAt(120.0, 25.0);
  const Eigen::Vector3d sun = day.sun().towards.vector();
  renderer.look(lookingAt(Eigen::Vector3d::Zero(), sun));
  const image::LinearImage image = renderer.light(day);
  const Eigen::Isometry3d pose = lookingAt(Eigen::Vector3d::Zero(), sun);
  double illuminance = 0.0;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const Eigen::Vector3d ray = options.camera.unproject({static_cast<double>(x), static_cast<double>(y)});
      const double solid_angle = 1.0 / (options.camera.fx * options.camera.fy) / std::pow(ray.norm(), 3.0);
      const float sky = day.skyLuminance((pose.linear() * ray).normalized().cast<float>()).value[1];
      illuminance += static_cast<double>(at(image, x, y)[1] - sky) * solid_angle;
    }
  }
  // 64 points a pixel find the area of a disc of 57 px within 1 %.
  const double expected = day.sun().illuminance.value[1];
  EXPECT_NEAR(illuminance, expected, 0.01 * expected);
}

}  // namespace
}  // namespace sunlit::test
