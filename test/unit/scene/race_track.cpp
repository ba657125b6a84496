#include "sunlit/scene/race_track.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "scene/noise.h"
#include "scene/race_track/course.h"
#include "scene/race_track/ground.h"
#include "sunlit/image/content_hash.h"
#include "sunlit/path/path.h"

namespace sunlit::scene {
namespace {

const Scene& world() {
  static const Scene scene = raceTrack();
  return scene;
}

std::string fingerprint(const Scene& scene) {
  image::ContentHash print;
  for (const Texture& texture : scene.textures) print.addBytes(texture.rgba.data(), texture.rgba.size());
  for (const Mesh& mesh : scene.meshes) {
    print.add(mesh.positions);
    print.add(mesh.normals);
    print.add(mesh.texture_coordinates);
    print.add(mesh.colors);
    print.add(mesh.triangles);
  }
  return print.text();
}

/// Height of the highest surface of the asphalt below (x, y, ∞), if there is any.
std::optional<double> roadHeight(double x, double y) {
  std::optional<double> height;
  for (const Mesh& mesh : world().meshes) {
    if (world().materials[static_cast<std::size_t>(mesh.material)].name != "asphalt") continue;
    for (const auto& t : mesh.triangles) {
      const Eigen::Vector3d a = mesh.positions[t[0]].cast<double>();
      const Eigen::Vector3d b = mesh.positions[t[1]].cast<double>();
      const Eigen::Vector3d c = mesh.positions[t[2]].cast<double>();
      const double area = (b.x() - a.x()) * (c.y() - a.y()) - (c.x() - a.x()) * (b.y() - a.y());
      const double u = ((x - a.x()) * (c.y() - a.y()) - (c.x() - a.x()) * (y - a.y())) / area;
      const double v = ((b.x() - a.x()) * (y - a.y()) - (x - a.x()) * (b.y() - a.y())) / area;
      if (u < 0.0 || v < 0.0 || u + v > 1.0) continue;
      const double z = a.z() + u * (b.z() - a.z()) + v * (c.z() - a.z());
      height = std::max(height.value_or(z), z);
    }
  }
  return height;
}

TEST(RaceTrack, IsTheSameBitsAtEveryCallAndForAnyThreadCount) {
  const std::string with_all_threads = fingerprint(world());
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(with_all_threads, fingerprint(raceTrack()));
}

TEST(RaceTrack, IsAValidScene) {
  EXPECT_NO_THROW(validate(world()));
  EXPECT_TRUE(world().warnings.empty());
  EXPECT_EQ(world().name, "race_track");
}

TEST(RaceTrack, HasEnoughTrianglesAndModestTextures) {
  EXPECT_GE(world().triangleCount(), 200000u);
  EXPECT_LE(world().triangleCount(), 700000u);
  std::size_t bytes = 0;
  for (const Texture& texture : world().textures) bytes += texture.rgba.size();
  EXPECT_LE(bytes, 160000000u);
}

TEST(RaceTrack, NormalsAreOfUnitLength) {
  for (const Mesh& mesh : world().meshes) {
    for (const Eigen::Vector3f& normal : mesh.normals) {
      // Single precision: a few roundings of 6e-8.
      ASSERT_NEAR(normal.norm(), 1.0f, 1e-5f) << mesh.name;
    }
  }
}

TEST(RaceTrack, TrianglesLieWithinTheirVertices) {
  for (const Mesh& mesh : world().meshes) {
    for (const auto& triangle : mesh.triangles) {
      for (const std::uint32_t index : triangle) ASSERT_LT(index, mesh.positions.size()) << mesh.name;
    }
  }
}

TEST(RaceTrack, MeshesNearTheTrackAreCompact) {
  for (const Mesh& mesh : world().meshes) {
    Eigen::AlignedBox3f box;
    for (const Eigen::Vector3f& p : mesh.positions) box.extend(p);
    if (std::max(box.min().head<2>().cwiseAbs().maxCoeff(), box.max().head<2>().cwiseAbs().maxCoeff()) >
        230.0f)
      continue;
    // Cells of 64 m, and the longest single part (the roof of the pits) reaches 70 m out of its own.
    EXPECT_LE(box.sizes().head<2>().maxCoeff(), 140.0f) << mesh.name;
  }
}

TEST(RaceTrack, AlbedosAreReal) {
  // Nothing outdoors but fresh snow reflects more than 0.9.
  for (const Mesh& mesh : world().meshes) {
    const Material& material = world().materials[static_cast<std::size_t>(mesh.material)];
    if (material.base_texture != Material::kNoTexture) continue;
    for (const Eigen::Array3f& color : mesh.colors) {
      const float brightest = (color * material.base_color.value).maxCoeff();
      ASSERT_LE(brightest, 0.9f) << mesh.name;
      ASSERT_GE((color * material.base_color.value).minCoeff(), 0.0f) << mesh.name;
    }
  }
}

TEST(RaceTrackCourse, IsClosedAndAtLeastAKilometreLong) {
  const race_track::Course& course = race_track::course();
  EXPECT_GE(course.length(), 1000.0);
  // The same place, reached after one lap; the line is sampled every half metre and linear between.
  EXPECT_LT((course.point({0.0, 0.0}) - course.point({course.length(), 0.0})).norm(), 1e-9);
}

TEST(RaceTrackCourse, NearestUndoesPoint) {
  const race_track::Course& course = race_track::course();
  for (double along = 3.0; along < course.length(); along += 7.3) {
    for (const double left : {-6.0, -1.0, 0.0, 4.0}) {
      const race_track::TrackPlace place = course.nearest(course.point({along, left}));
      // Three steps of Newton's method on a line made of half-metre chords: some centimetres along, less
      // across.
      EXPECT_NEAR(std::remainder(place.along - along, course.length()), 0.0, 0.05);
      EXPECT_NEAR(place.left, left, 0.01);
    }
  }
}

TEST(RaceTrackGround, IsClosedAtTheStart) {
  const double length = race_track::course().length();
  for (double left = -40.0; left <= 40.0; left += 0.5) {
    const double before = race_track::groundHeight(race_track::TrackPlace{length - 0.005, left});
    const double after = race_track::groundHeight(race_track::TrackPlace{0.005, left});
    // 1 cm further on: no slope of the land beside the track is steeper than 1 : 1.
    EXPECT_NEAR(before, after, 0.01) << left;
    // Distances along the track are cyclic, but for their own rounding.
    EXPECT_NEAR(race_track::groundHeight(race_track::TrackPlace{-20.0, left}),
                race_track::groundHeight(race_track::TrackPlace{length - 20.0, left}), 1e-6)
        << left;
  }
}

TEST(RaceTrackPath, Gives991Poses) {
  EXPECT_EQ(path::posesAlong(raceTrackWaypoints(), path::PathOptions()).size(), 991u);
}

TEST(RaceTrackPath, SegmentsStayClearOfWholeMetres) {
  // Else rounding would decide how many poses a segment has.
  const std::vector<Eigen::Vector3d> waypoints = raceTrackWaypoints();
  for (std::size_t i = 0; i + 1 < waypoints.size(); ++i) {
    const double plan = (waypoints[i + 1] - waypoints[i]).head<2>().norm();
    const double space = (waypoints[i + 1] - waypoints[i]).norm();
    EXPECT_GT(std::abs(plan - std::round(plan)), 0.05);
    EXPECT_EQ(std::ceil(plan), std::ceil(space)) << "slope changes the number of poses of segment " << i;
  }
}

TEST(RaceTrackPath, LiesOnTheAsphalt) {
  for (const Eigen::Vector3d& waypoint : raceTrackWaypoints()) {
    const std::optional<double> height = roadHeight(waypoint.x(), waypoint.y());
    ASSERT_TRUE(height.has_value()) << waypoint.transpose();
    // The mesh is made of flat cells 2 m long; on the road's swells that leaves millimetres.
    EXPECT_NEAR(*height, waypoint.z(), 0.01);
  }
}

TEST(RaceTrackPath, DrivesOnceRound) {
  const race_track::Course& course = race_track::course();
  double travelled = 0.0;
  const std::vector<Eigen::Vector3d> waypoints = raceTrackWaypoints();
  for (std::size_t i = 0; i + 1 < waypoints.size(); ++i) {
    const double from = course.nearest(waypoints[i].head<2>()).along;
    const double to = course.nearest(waypoints[i + 1].head<2>()).along;
    const double step = std::remainder(to - from, course.length());
    EXPECT_GT(step, 0.0);
    travelled += step;
  }
  EXPECT_GT(travelled, 0.9 * course.length());
  EXPECT_LT(travelled, course.length());
}

TEST(RaceTrackPictures, NoTwoAreAlike) {
  std::set<std::string> seen;
  for (const Texture& texture : world().textures) {
    image::ContentHash print;
    print.addBytes(texture.rgba.data(), texture.rgba.size());
    EXPECT_TRUE(seen.insert(print.text()).second) << texture.name;
  }
}

/// Copies of one patch in the picture of the road: blocks of 16×16 px (64×32 cm) that equal another one.
TEST(RaceTrackPictures, TheRoadRepeatsNowhere) {
  constexpr int kBlock = 16;
  std::map<std::string, std::string> seen;
  int repeated = 0;
  int blocks = 0;
  for (const Texture& texture : world().textures) {
    if (texture.name.rfind("road", 0) != 0) continue;
    for (int y = 0; y + kBlock <= texture.height; y += kBlock) {
      for (int x = 0; x + kBlock <= texture.width; x += kBlock) {
        image::ContentHash print;
        for (int row = 0; row < kBlock; ++row) {
          const auto first =
              texture.rgba.begin() + 4 * (static_cast<std::ptrdiff_t>(y + row) * texture.width + x);
          print.add(std::vector<std::uint8_t>(first, first + 4 * kBlock));
        }
        ++blocks;
        repeated += seen.emplace(print.text(), texture.name).second ? 0 : 1;
      }
    }
  }
  EXPECT_GT(blocks, 50000);
  EXPECT_EQ(repeated, 0);
}

/// A picture that is shown once only makes no twins. Leaves, grass, people and wire are shown many times,
/// each time cut, turned or tinted anew; all other pictures are unique.
TEST(RaceTrackPictures, OpaqueOnesAreShownOnce) {
  std::map<int, std::set<std::array<float, 4>>> places;
  int repeated = 0;
  int quads = 0;
  for (const Mesh& mesh : world().meshes) {
    const Material& material = world().materials[static_cast<std::size_t>(mesh.material)];
    if (material.name.rfind("pictures", 0) != 0) continue;
    for (std::size_t i = 0; i + 3 < mesh.texture_coordinates.size(); i += 4) {
      const Eigen::Vector2f& a = mesh.texture_coordinates[i];
      const Eigen::Vector2f& b = mesh.texture_coordinates[i + 2];
      ++quads;
      repeated += places[mesh.material].insert({a.x(), a.y(), b.x(), b.y()}).second ? 0 : 1;
    }
  }
  EXPECT_GT(quads, 300);
  EXPECT_EQ(repeated, 0);
}

TEST(RaceTrackNoise, IsSmoothAndBounded) {
  for (int i = 0; i < 2000; ++i) {
    const float x = 0.037f * static_cast<float>(i) - 20.0f;
    const float here = noise(x, 1.7f, 5u);
    EXPECT_LE(std::abs(here), 1.0f);
    // Its steepest slope is 15/8 of the step between lattice values, at most 2.
    EXPECT_LE(std::abs(noise(x + 0.001f, 1.7f, 5u) - here), 0.001f * 3.75f + 1e-5f);
  }
}

TEST(RaceTrack, ItsPathIsLitByStreetLampsAtNight) {
  std::size_t street = 0, stands = 0;
  for (const Lamp& lamp : world().lamps) {
    if (lamp.group == "windows") continue;
    (lamp.group == "street_lamps" ? street : stands) += 1;
    EXPECT_TRUE(lamp.group == "street_lamps" || lamp.group == "grandstand") << lamp.group;
    EXPECT_TRUE(lamp.isSpot());
    EXPECT_FALSE(lamp.relative);
  }
  EXPECT_GT(street, 25u);  // one each 33 m of nearly 1 km
  EXPECT_GT(stands, 0u);
  // From each point of the path there is a street lamp above, not farther than half their distance and the
  // road's width away.
  for (const Eigen::Vector3d& point : raceTrackWaypoints()) {
    double nearest = 1e9;
    for (const Lamp& lamp : world().lamps) {
      if (lamp.group != "street_lamps") continue;
      const Eigen::Vector3d way = lamp.position.cast<double>() - point;
      if (way.z() > 5.0 && way.z() < 12.0) nearest = std::min(nearest, way.head<2>().norm());
    }
    EXPECT_LT(nearest, 35.0);
  }
}

float linearOf(std::uint8_t code) {
  const float value = static_cast<float>(code) / 255.0f;  // IEC 61966-2-1
  return value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
}

/// What the facades show by night, by texture coordinates: cd/m².
Eigen::Array3f shownAt(const Material& facade, const Eigen::Vector2f& place) {
  const Texture& texture = world().textures.at(static_cast<std::size_t>(facade.emission_map.texture));
  const auto x = static_cast<std::size_t>(place.x() * static_cast<float>(texture.width));
  const auto y = static_cast<std::size_t>(place.y() * static_cast<float>(texture.height));
  const std::uint8_t* texel = &texture.rgba[4 * (y * static_cast<std::size_t>(texture.width) + x)];
  return facade.emission.value * Eigen::Array3f(linearOf(texel[0]), linearOf(texel[1]), linearOf(texel[2]));
}

/// The luminance that the facade shows at `point`; none where there is no facade that faces `towards`.
std::optional<float> shownAt(const Eigen::Vector3f& point, const Eigen::Vector3f& towards) {
  for (const Mesh& mesh : world().meshes) {
    const Material& material = world().materials[static_cast<std::size_t>(mesh.material)];
    if (material.lamp_group != "windows") continue;
    for (const auto& t : mesh.triangles) {
      const Eigen::Vector3f a = mesh.positions[t[0]], ab = mesh.positions[t[1]] - a,
                            ac = mesh.positions[t[2]] - a;
      const Eigen::Vector3f normal = ab.cross(ac).normalized();
      // Millimetres: positions are floats of some 100 m.
      if (normal.dot(towards) < 0.999f || std::abs(normal.dot(point - a)) > 2e-3f) continue;
      const float area = ab.cross(ac).dot(normal);
      const float v = ab.cross(point - a).dot(normal) / area, u = (point - a).cross(ac).dot(normal) / area;
      if (u < 0.0f || v < 0.0f || u + v > 1.0f) continue;
      const Eigen::Vector2f place = (1.0f - u - v) * mesh.texture_coordinates[t[0]] +
                                    u * mesh.texture_coordinates[t[1]] + v * mesh.texture_coordinates[t[2]];
      return LinearRgb(shownAt(material, place)).luminance();
    }
  }
  return std::nullopt;
}

TEST(RaceTrackWindows, ShineBehindTheirLamps) {
  std::size_t lit = 0, behind_curtains = 0;
  for (const Lamp& lamp : world().lamps) {
    if (lamp.group != "windows") continue;
    ++lit;
    // By the cosine, as an even sheet shines.
    EXPECT_EQ(lamp.exponent, 1.0f);
    EXPECT_EQ(lamp.inner_rad, 0.0f);
    EXPECT_NEAR(lamp.outer_rad, 0.5 * M_PI, 1e-6);
    EXPECT_NEAR(lamp.direction.z(), 0.0f, 1e-6f);
    // 5 cm behind it, beside the bars between and across the panes: in two panes at least one is no
    // furniture.
    const Eigen::Vector3f right = lamp.direction.cross(Eigen::Vector3f::UnitZ());
    float brightest = 0.0f;
    for (const float aside : {-0.2f, 0.2f}) {
      for (const float up : {-0.3f, 0.3f}) {
        const std::optional<float> shown =
            shownAt(lamp.position - 0.05f * lamp.direction + aside * right + up * Eigen::Vector3f::UnitZ(),
                    lamp.direction);
        ASSERT_TRUE(shown.has_value()) << lamp.position.transpose();
        brightest = std::max(brightest, *shown);
      }
    }
    // Rooms of 30 to 110 cd/m², 1.35 times as much beside their lamps and in the folds of what hangs at their
    // sides; behind drawn curtains a twenty-fifth of that at least.
    EXPECT_GT(brightest, 0.6f) << lamp.position.transpose();
    EXPECT_LT(brightest, 150.0f) << lamp.position.transpose();
    behind_curtains += brightest < 15.0f ? 1 : 0;
  }
  EXPECT_GT(lit, 50u);
  EXPECT_GT(behind_curtains, lit / 3);
  EXPECT_LT(behind_curtains, lit - lit / 5);
}

TEST(RaceTrackWindows, GiveTheLightThatTheyShow) {
  // cd of all lamps, and of all texels of 1/30 m: each shows its luminance over its area.
  Eigen::Array3f given = Eigen::Array3f::Zero(), shown = Eigen::Array3f::Zero();
  for (const Lamp& lamp : world().lamps) {
    if (lamp.group == "windows") given += lamp.intensity.value;
  }
  std::size_t bright = 0, all = 0;
  for (const Material& material : world().materials) {
    if (material.lamp_group != "windows") continue;
    const Texture& texture = world().textures.at(static_cast<std::size_t>(material.emission_map.texture));
    for (std::size_t i = 0; i < texture.rgba.size(); i += 4) {
      const Eigen::Array3f texel(linearOf(texture.rgba[i]), linearOf(texture.rgba[i + 1]),
                                 linearOf(texture.rgba[i + 2]));
      shown += material.emission.value * texel / (30.0f * 30.0f);
      all += texture.rgba[i + 3] > 0 ? 1 : 0;
      bright += texel.maxCoeff() > 0.0f ? 1 : 0;
    }
  }
  for (int channel = 0; channel < 3; ++channel) {
    // Rounding to 8 bits, a half of a code of 50 is 2.5 %, means out over thousands of texels.
    EXPECT_NEAR(given[channel], shown[channel], 0.01f * shown[channel]) << channel;
  }
  EXPECT_GT(given[0], 1.2f * given[1]);  // warm
  EXPECT_GT(given[1], 1.2f * given[2]);
  // Some of the windows, which are a sixth of the walls or so.
  EXPECT_GT(bright, all / 50);
  EXPECT_LT(bright, all / 10);
}

}  // namespace
}  // namespace sunlit::scene
