// What a camera with a lens sees lies where the lens puts it, at its own depth, without seams between the
// pictures that it is drawn on.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <opencv2/calib3d.hpp>

#include "sunlit/scene/robot.h"
#include "support/message_of.h"
#include "support/published_lenses.h"
#include "test_scenes.h"

namespace sunlit::test {
namespace {

const Eigen::Vector3d kEye(3.0, -2.0, 1.5);
const Eigen::Vector3d kTarget(9.0, 1.0, 2.0);

render::RenderOptions cameraOf(const PublishedLens& lens, int supersampling) {
  render::RenderOptions options;
  options.camera = lens.camera;
  options.distortion = lens.distortion;
  options.supersampling = supersampling;
  return options;
}

/// Corner `i` of a disc across `towards`, whose middle it is, counted from the eye; whole numbers are
/// corners, between them lie its sides.
constexpr int kDiscCorners = 32;
Eigen::Vector3d onRim(const Eigen::Vector3d& towards, double radius, double i) {
  const Eigen::Vector3d right = towards.unitOrthogonal(), up = towards.normalized().cross(right);
  const auto corner = [&](double k) {
    const double turn = 2.0 * kPi * k / kDiscCorners;
    return Eigen::Vector3d(towards + radius * (std::cos(turn) * right + std::sin(turn) * up));
  };
  const double before = std::floor(i);
  return corner(before) + (i - before) * (corner(before + 1.0) - corner(before));
}

void addDisc(scene::Scene* scene, int material, const Eigen::Vector3d& towards, double radius) {
  scene::Mesh mesh;
  mesh.name = "disc " + std::to_string(scene->meshes.size());
  mesh.material = material;
  for (std::uint32_t i = 0; i < kDiscCorners; ++i) {
    mesh.positions.push_back((kEye + onRim(towards, radius, i)).cast<float>());
    mesh.normals.push_back((-towards.normalized()).cast<float>());
    if (i >= 2) mesh.triangles.push_back({0, i, i - 1});
  }
  scene->meshes.push_back(mesh);
}

/// Where OpenCV has a point of the optical frame; before its fisheye, which knows what is in front alone,
/// ours.
Eigen::Vector2d expectedPixel(const PublishedLens& published, const Eigen::Vector3d& point) {
  const image::LensModel model = published.distortion.model;
  const image::PinholeCamera& c = published.camera;
  const cv::Matx33d k(c.fx, 0, c.cx, 0, c.fy, c.cy, 0, 0, 1);
  const std::vector<cv::Vec3d> points = {{point.x(), point.y(), point.z()}};
  const cv::Vec3d none(0, 0, 0);
  std::vector<cv::Vec2d> pixels;
  if (model == image::LensModel::kEquidistant && point.z() > 0.1 * point.norm()) {
    cv::fisheye::projectPoints(points, pixels, none, none, k, published.distortion.coefficients);
  } else if (model == image::LensModel::kPlumbBob || model == image::LensModel::kRationalPolynomial) {
    cv::projectPoints(points, none, none, k, published.distortion.coefficients, pixels);
  } else {
    return published.lens().project(point).value();
  }
  return {pixels[0][0], pixels[0][1]};
}

/// The middle of a disc's picture, by its rim alone (Green's theorem); `towards` in the optical frame.
Eigen::Vector2d expectedMiddle(const PublishedLens& published, const Eigen::Vector3d& towards,
                               double radius) {
  constexpr int kPartsOfSides = 8;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double area = 0.0;
  const Eigen::Vector2d about = expectedPixel(published, towards);
  for (int i = 0; i < kDiscCorners * kPartsOfSides; ++i) {
    const auto at = [&](int k) {
      return Eigen::Vector2d(
          expectedPixel(published, onRim(towards, radius, static_cast<double>(k) / kPartsOfSides)) - about);
    };
    const Eigen::Vector2d a = at(i), b = at(i + 1);
    const double twice = a.x() * b.y() - a.y() * b.x();
    area += 0.5 * twice;
    sum += twice / 6.0 * (a + b);
  }
  return about + sum / area;
}

constexpr int kDotsAcross = 5, kDotsDown = 5;

/// The middles of what each material's samples see of a picture, by material.
std::map<int, Eigen::Vector2d> middlesOf(const light::Surfaces& surfaces) {
  std::map<int, Eigen::Vector3d> sums;
  for (const light::Tile& tile : surfaces.tiles) {
    for (const light::Surface& surface : tile.surfaces) {
      const auto pixel = static_cast<int>(surface.pixel);
      sums.emplace(surface.material, Eigen::Vector3d::Zero());
      sums[surface.material] +=
          surface.samples * Eigen::Vector3d(pixel % surfaces.width, pixel / surfaces.width, 1.0);
    }
  }
  std::map<int, Eigen::Vector2d> middles;
  for (const auto& [material, sum] : sums) middles[material] = sum.head<2>() / sum.z();
  return middles;
}

// Dots of 14 px radius or more, each across its own ray. Samples a quarter of a pixel apart leave the middle
// of a rim of 88 px known to 0.004 px or so, and the worst of 25 dots to 0.013 px, with a pinhole, too.
TEST(LensPicture, DotsLieWhereOpenCvProjectsThem) {
  for (const PublishedLens& published : publishedLenses()) {
    const image::Lens lens = published.lens();
    const Eigen::Isometry3d map_from_optical = lookingAt(kEye, kTarget);
    scene::Scene scene;
    std::vector<Eigen::Vector2d> wanted;
    for (int i = 0; i < kDotsAcross * kDotsDown; ++i) {
      const Eigen::Vector2d pixel(
          48.0 + (published.camera.width - 97.0) * (i % kDotsAcross) / (kDotsAcross - 1),
          48.0 + (published.camera.height - 97.0) * (i / kDotsAcross) / (kDotsDown - 1));
      const Eigen::Vector3d towards = 3.0 * lens.unproject(pixel).value().normalized();
      const auto next = [&](double x, double y) {
        return (3.0 * lens.unproject(pixel + Eigen::Vector2d(x, y)).value().normalized() - towards).norm();
      };
      const double radius = 14.0 * std::max(next(1.0, 0.0), next(0.0, 1.0));
      addDisc(&scene, addMaterial(&scene, {0.5f, 0.5f, 0.5f}), map_from_optical.linear() * towards, radius);
      wanted.push_back(expectedMiddle(published, towards, radius));
    }
    render::Renderer renderer(shared(std::move(scene)), cameraOf(published, 4));
    renderer.look(map_from_optical);
    const std::map<int, Eigen::Vector2d> middles = middlesOf(renderer.surfaces());
    ASSERT_EQ(middles.size(), wanted.size()) << published.name;
    double worst = 0.0;
    for (const auto& [material, middle] : middles)
      worst = std::max(worst, (middle - wanted[static_cast<std::size_t>(material)]).norm());
    EXPECT_LT(worst, 0.025) << published.name;
    std::printf("%s: dots within %.4f px\n", published.name.c_str(), worst);
  }
}

constexpr float kRoom = 4.0f;

/// A room about the eye, of which every ray meets one wall.
scene::Scene room() {
  scene::Scene scene;
  const int material = addMaterial(&scene, {0.5f, 0.5f, 0.5f});
  scene.materials[0].double_sided = true;
  const Eigen::Vector3f half = Eigen::Vector3f::Constant(kRoom);
  addBlock(&scene, material, kEye.cast<float>() - half, 2.0f * half);
  return scene;
}

/// Of a ray from the eye, in units of its length.
double wallDepth(const Eigen::Vector3d& ray) {
  return static_cast<double>(kRoom) / ray.cwiseAbs().maxCoeff();
}

class LensPictureBy : public testing::TestWithParam<render::RasterizerKind> {
 protected:
  void SetUp() override {
    try {
      render::requireStarts(GetParam());
    } catch (const std::runtime_error& error) {
      GTEST_SKIP() << error.what();
    }
  }
};

// Planes are known to 1e-7 of their distance, rays to 1e-7, so depth to some 1e-6 where a wall is seen at a
// slant of 70°; at the room's edges either wall.
TEST_P(LensPictureBy, AWallsDepthIsItsPlanesOutToTheWidestAngle) {
  for (const PublishedLens& published : publishedLenses()) {
    render::RenderOptions options = cameraOf(published, 1);
    options.rasterizer = GetParam();
    render::Renderer renderer(shared(room()), options);
    const Eigen::Isometry3d map_from_optical = lookingAt(kEye, kTarget);
    renderer.look(map_from_optical);
    const image::DepthImage depth = renderer.depth();
    const image::Lens lens = published.lens();
    double worst = 0.0;
    for (int y = 0; y < depth.height; ++y) {
      for (int x = 0; x < depth.width; ++x) {
        const Eigen::Vector3d ray = map_from_optical.linear() * lens.unproject({x, y}).value();
        const double truth = wallDepth(ray);
        const double off = std::abs(static_cast<double>(*depth.at(x, y)) / truth - 1.0);
        worst = std::isnan(off) ? 1e9 : std::max(worst, off);
      }
    }
    EXPECT_LT(worst, 1e-5) << published.name;
  }
}

// What a sample sees beside the edges of the room is off by less than a sample, whichever face it was drawn
// on.
TEST_P(LensPictureBy, SeesNoHolesAndNoSeamsInARoom) {
  for (const PublishedLens& published : {tumViLens(), t265Lens(), omniLens()}) {
    render::RenderOptions options = cameraOf(published, 2);
    options.rasterizer = GetParam();
    render::Renderer renderer(shared(room()), options);
    renderer.look(lookingAt(kEye, kTarget));
    double worst = 0.0;
    for (const light::Tile& tile : renderer.surfaces().tiles) {
      for (const std::uint8_t sky : tile.sky) ASSERT_EQ(sky, 0) << published.name;
      for (const light::Surface& surface : tile.surfaces) {
        const Eigen::Vector3d at = surface.position.cast<double>() - kEye;
        worst = std::max(worst, std::abs(at.cwiseAbs().maxCoeff() - static_cast<double>(kRoom)));
      }
    }
    EXPECT_LT(worst, 1e-4) << published.name;  // m: single precision at 5 m, a hundred times
  }
}

INSTANTIATE_TEST_SUITE_P(By, LensPictureBy, testing::ValuesIn(render::builtRasterizers()),
                         [](const auto& each) { return render::nameOf(each.param); });

/// Hills, a fence of posts, and blocks.
scene::Scene yard() {
  scene::Scene scene;
  const int stone = addMaterial(&scene, {0.4f, 0.35f, 0.3f}), red = addMaterial(&scene, {0.6f, 0.1f, 0.1f});
  scene.materials[1].roughness = 0.05f;  // mirrors sky and ground
  addGround(&scene, stone, 60.0f);
  for (int i = 0; i < 40; ++i) {
    const auto along = static_cast<float>(i);
    addBlock(&scene, i % 3 == 0 ? red : stone, {-12.0f + 0.9f * along, 6.0f - 0.3f * along, 0.0f},
             {0.1f, 0.1f, 1.0f + 0.1f * along});
  }
  return scene;
}

// A lens that bends by less than any rounding is drawn another way, and shows the same but for edges.
TEST(LensPicture, OfALensThatHardlyBendsIsThePinholesPicture) {
  render::RenderOptions options = smallCamera(320, 240, 70.0);
  const auto scene = shared(yard());
  render::Renderer straight(scene, options);
  options.distortion.coefficients[0] = 1e-9;
  render::Renderer bent(scene, options);
  const Eigen::Isometry3d pose = lookingAt({-6.0, -5.0, 2.0}, {3.0, 4.0, 0.5});
  straight.look(pose);
  bent.look(pose);
  const sky::Daylight day = daylightAt(200.0, 40.0);
  const image::LinearImage a = straight.light(day), b = bent.light(day);
  std::size_t differing = 0;
  for (std::size_t i = 0; i < a.data.size(); ++i)
    differing += std::abs(a.data[i] - b.data[i]) > 0.01f * a.data[i] ? 1 : 0;
  EXPECT_LT(static_cast<double>(differing), 0.01 * static_cast<double>(a.data.size()));
}

TEST(LensPicture, HasTheSameBitsForAnyNumberOfThreads) {
  const auto scene = shared(yard());
  const sky::Daylight day = daylightAt(200.0, 40.0);
  std::vector<std::vector<float>> pictures;
  for (const std::size_t threads : {1, 3, 8}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    render::Renderer renderer(scene, cameraOf(tumViLens(), 2));
    renderer.look(lookingAt({-6.0, -5.0, 2.0}, {3.0, 4.0, 0.5}));
    pictures.push_back(renderer.light(day).data);
  }
  EXPECT_EQ(pictures[1], pictures[0]);
  EXPECT_EQ(pictures[2], pictures[0]);
}

TEST(LensPicture, WithoutDistortionHasThePinholesBits) {
  render::RenderOptions options = smallCamera(320, 240, 70.0);
  const auto scene = shared(yard());
  const sky::Daylight day = daylightAt(200.0, 40.0);
  const Eigen::Isometry3d pose = lookingAt({-6.0, -5.0, 2.0}, {3.0, 4.0, 0.5});
  const auto picture = [&](const image::Distortion& distortion) {
    options.distortion = distortion;
    render::Renderer renderer(scene, options);
    renderer.look(pose);
    return renderer.light(day).data;
  };
  const std::vector<float> pinhole = picture({});
  EXPECT_EQ(picture({image::LensModel::kPlumbBob, {0, 0, 0, 0}}), pinhole);
  EXPECT_EQ(picture({image::LensModel::kRationalPolynomial, std::vector<double>(8, 0.0)}), pinhole);
}

// Edges that rasterizers round in their own way differ, and no more.
TEST(LensPicture, OfEachRasterizerIsTheSameButForEdges) {
  for (const PublishedLens& published : {eurocLens(), tumViLens()}) {
    std::vector<image::DepthImage> depths;
    for (const render::RasterizerKind kind : render::builtRasterizers()) {
      try {
        render::requireStarts(kind);
      } catch (const std::runtime_error&) {
        continue;
      }
      render::RenderOptions options = cameraOf(published, 2);
      options.rasterizer = kind;
      render::Renderer renderer(shared(yard()), options);
      renderer.look(lookingAt({-6.0, -5.0, 2.0}, {3.0, 4.0, 0.5}));
      depths.push_back(renderer.depth());
    }
    for (std::size_t k = 1; k < depths.size(); ++k) {
      std::size_t differing = 0;
      for (std::size_t i = 0; i < depths[k].data.size(); ++i) {
        const float a = depths[0].data[i], b = depths[k].data[i];
        const bool same = (std::isnan(a) && std::isnan(b)) || std::abs(a - b) < 1e-5f * a;
        differing += same ? 0 : 1;
      }
      EXPECT_LT(static_cast<double>(differing), 5e-4 * static_cast<double>(depths[k].data.size()));
    }
  }
}

/// A panel of 2 m by 2 m whose front is at its own origin.
constexpr const char* kPanel = R"(<?xml version="1.0"?>
<robot name="panel"><material name="red"><color rgba="0.8 0.1 0.1 1"/></material>
  <link name="base_link"><visual><origin xyz="0.05 0 0"/><geometry><box size="0.1 2 2"/></geometry>
    <material name="red"/></visual></link></robot>)";

// What moves is drawn on every face of the canvas: a panel that stands across a seam, 45° aside, is there
// whole.
TEST(LensPicture, ShowsARobotAcrossTheSeamsOfItsFaces) {
  const scene::Robot robot = scene::parseUrdf(kPanel, "panel.urdf", {});
  scene::Scene scene;
  addGround(&scene, addMaterial(&scene, {0.5f, 0.5f, 0.5f}), 60.0f);
  const auto meshes = scene::addLooks(robot, &scene);
  const light::World world(shared(std::move(scene)), meshes);
  const PublishedLens published = tumViLens();
  render::Renderer renderer(world, cameraOf(published, 1));
  const Eigen::Isometry3d map_from_optical = lookingAt({0.0, 0.0, 1.5}, {10.0, 0.0, 1.5});
  Eigen::Isometry3d panel = Eigen::Isometry3d::Identity();
  panel.translation() = Eigen::Vector3d(3.0, 3.0, 1.5);
  panel.linear() = Eigen::AngleAxisd(0.25 * kPi, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  renderer.look(map_from_optical, {panel});
  const image::DepthImage depth = renderer.depth();
  const image::Lens lens = published.lens();
  int checked = 0;
  for (int y = 0; y < depth.height; ++y) {
    for (int x = 0; x < depth.width; ++x) {
      const Eigen::Vector3d ray = map_from_optical.linear() * lens.unproject({x, y}).value();
      // The panel's front is the plane x = 0 of its frame.
      const Eigen::Vector3d eye = panel.inverse() * map_from_optical.translation();
      const Eigen::Vector3d along = panel.linear().transpose() * ray;
      const double there = -eye.x() / along.x();
      const Eigen::Vector3d at = eye + there * along;
      if (!(there > 0.0) || std::abs(at.y()) > 0.97 || std::abs(at.z()) > 0.97) continue;
      ++checked;
      EXPECT_NEAR(static_cast<double>(*depth.at(x, y)) / there, 1.0, 1e-5) << x << ' ' << y;
    }
  }
  EXPECT_GT(checked, 3000);
}

// With nothing in the way each pixel has the sky of its own ray, but for what is interpolated, 0.1 %, and the
// sun.
TEST(LensPicture, ShowsTheSkyAlongItsOwnRays) {
  scene::Scene scene;
  addPatch(&scene, addMaterial(&scene, {0.5f, 0.5f, 0.5f}), {0, 0, -500}, {1, 0, 0}, {0, 1, 0});
  const auto nothing = shared(std::move(scene));
  const sky::Daylight day = daylightAt(200.0, 40.0);
  for (const PublishedLens& published : publishedLenses()) {
    render::Renderer renderer(nothing, cameraOf(published, 1));
    const Eigen::Isometry3d map_from_optical = lookingAt(kEye, kEye + Eigen::Vector3d(0.3, 0.2, 1.0));
    renderer.look(map_from_optical);
    const image::LinearImage picture = renderer.light(day);
    const image::Lens lens = published.lens();
    const Eigen::Vector3d sun = day.sun().towards.vector();
    Eigen::Array3d of_sun = Eigen::Array3d::Zero();
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();
    for (int y = 0; y < picture.height; ++y) {
      for (int x = 0; x < picture.width; ++x) {
        const auto ray = [&](double u, double v) {
          return Eigen::Vector3d(map_from_optical.linear() * lens.unproject({u, v}).value().normalized());
        };
        const Eigen::Vector3d towards = ray(x, y);
        if (towards.z() < 0.02) continue;  // the horizon
        const Eigen::Array3f sky = day.skyLuminance(Eigen::Vector3f(towards.cast<float>())).value;
        if (towards.dot(sun) > std::cos(0.02)) {
          const double solid_angle =
              (ray(x + 0.5, y) - ray(x - 0.5, y)).cross(ray(x, y + 0.5) - ray(x, y - 0.5)).norm();
          const Eigen::Array3d light = (at(picture, x, y) - sky).cast<double>() * solid_angle;
          of_sun += light;
          middle += light[1] * Eigen::Vector2d(x, y);
          continue;
        }
        ASSERT_LT(((at(picture, x, y) - sky).abs() / sky).maxCoeff(), 3e-3)
            << published.name << " " << x << " " << y;
      }
    }
    const auto of_disc = lens.project(map_from_optical.linear().transpose() * sun);
    if (!of_disc || of_disc->x() < 5 || of_disc->y() < 5 || of_disc->x() > picture.width - 6 ||
        of_disc->y() > picture.height - 6)
      continue;
    // The disc sends what it sends, from where it stands.
    EXPECT_LT((of_sun / day.sun().illuminance.value.cast<double>() - 1.0).abs().maxCoeff(), 0.01)
        << published.name;
    EXPECT_LT((middle / of_sun[1] - *of_disc).norm(), 0.05) << published.name;
  }
}

TEST(LensPicture, BeyondTheFoldIsRefusedByItsAngle) {
  PublishedLens wide = kittiLens();
  EXPECT_NO_THROW(render::validate(cameraOf(wide, 2)));
  wide.camera.width = 1900;
  wide.camera.cx = 950.0;
  const std::string message = messageOf([&] { render::validate(cameraOf(wide, 2)); });
  EXPECT_NE(message.find("50.1 degrees"), std::string::npos) << message;
}

}  // namespace
}  // namespace sunlit::test
