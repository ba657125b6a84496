// Roads, outlines and height maps of SDF, against areas and volumes by pencil.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <utility>
#include <vector>

#include "scene/outline.h"
#include "scene/ribbon.h"
#include "scene/terrain.h"
#include "unit/scene/measure.h"
#include "unit/scene/scene_files.h"

namespace sunlit::scene {
namespace {

// Of sums of floats of some metres.
constexpr double kTolerance = 1e-4;

Outline square(double low, double high) {
  return {{low, low}, {high, low}, {high, high}, {low, high}};
}

TEST(Outline, ASquareIsABox) {
  Outline closed = square(0, 2);
  closed.push_back(closed.front());
  for (const Outline& outline : {square(0, 2), closed}) {
    const Mesh box = extruded({outline}, 3.0);
    EXPECT_NEAR(volumeOf(box), 12.0, kTolerance);
    EXPECT_NEAR(areaOf(box), 2 * 4.0 + 4 * 6.0, kTolerance);
    EXPECT_FLOAT_EQ(boundsOf(box).min().z(), 0.0f);
    EXPECT_FLOAT_EQ(boundsOf(box).max().z(), 3.0f);
  }
  Outline turned = square(0, 2);
  std::reverse(turned.begin(), turned.end());
  EXPECT_NEAR(volumeOf(extruded({turned}, 3.0)), 12.0, kTolerance);
}

TEST(Outline, LoopsWithinLoopsCutHolesAndIslands) {
  const Mesh ring = extruded({square(0, 10), square(2, 8), square(4, 6)}, 1.0);
  EXPECT_NEAR(volumeOf(ring), 100.0 - 36.0 + 4.0, kTolerance);
  EXPECT_NEAR(areaOf(ring), 2 * 68.0 + 40.0 + 24.0 + 8.0, kTolerance);
  for (std::size_t i = 0; i < ring.triangles.size(); ++i)
    EXPECT_GT(faceVector(ring, ring.triangles[i]).dot(ring.normals[ring.triangles[i][0]].cast<double>()),
              0.0);
}

TEST(Outline, ALoopThatCrossesItselfIsFilledByEvenAndOdd) {
  // Two triangles of half a square metre each, tip to tip, whose turns are opposite.
  const Mesh bow = extruded({{{0, 0}, {1, 1}, {1, 0}, {0, 1}}}, 2.0);
  EXPECT_NEAR(volumeOf(bow), 2.0 * (0.25 + 0.25), kTolerance);
}

TEST(Outline, ASlantedOutlineHasItsArea) {
  // Shoelace: 0.5 |Σ x_i y_(i+1) − x_(i+1) y_i| = 0.5 (0 + 12 + 7 − 0 …) of these four points.
  const Outline kite = {{0, 0}, {4, 1}, {3, 5}, {-1, 2}};
  const double area = 0.5 * ((0 * 1 - 4 * 0) + (4 * 5 - 3 * 1) + (3 * 2 + 1 * 5) + (-1 * 0 - 0 * 2));
  EXPECT_NEAR(volumeOf(extruded({kite}, 1.0)), area, 1e-3);  // its corners lie on the grid, its cuts do not
  EXPECT_TRUE(extruded({{{0, 0}, {1, 1}}}, 1.0).triangles.empty());
}

TEST(Ribbon, IsAsWideAsItShouldBeAroundABend) {
  const Mesh bend = makeRibbon({{0, 0, 1}, {10, 0, 1}, {10, 10, 3}}, 4.0);
  EXPECT_EQ(bend.triangles.size(), 4u);
  // Seen from above: two strips of 10 m × 4 m; the mitre gives as much outside as it takes inside.
  double from_above = 0.0;
  for (const auto& triangle : bend.triangles) {
    EXPECT_GT(faceVector(bend, triangle).z(), 0.0);
    from_above += faceVector(bend, triangle).z();
  }
  EXPECT_NEAR(from_above, 80.0, kTolerance);
  const Eigen::AlignedBox3f box = boundsOf(bend);
  EXPECT_LT((box.min() - Eigen::Vector3f(0, -2, 1)).norm(), kTolerance);
  EXPECT_LT((box.max() - Eigen::Vector3f(12, 10, 3)).norm(), kTolerance);
  // Once a width: 10 m and √(10² + 2²) m.
  EXPECT_NEAR(bend.texture_coordinates.back().y(), (10.0 + std::sqrt(104.0)) / 4.0, kTolerance);
}

TEST(Ribbon, ATurnBackAndPointsGivenTwiceAreNoTrouble) {
  const Mesh back = makeRibbon({{0, 0, 0}, {0, 0, 0}, {10, 0, 0}, {0, 0, 0}}, 2.0);
  EXPECT_FLOAT_EQ(boundsOf(back).max().x(), 10.0f);
  EXPECT_TRUE(makeRibbon({{1, 1, 0}, {1, 1, 5}}, 2.0).triangles.empty());
}

TEST(Terrain, WhiteIsAsHighAsTheMap) {
  image::Picture<float, 1> values(3, 2);
  values.data = {0.0f, 0.25f, 0.5f, 0.0f, 0.0f, 0.125f};
  TerrainGrid grid{3, 2, terrainHeights(values, 8.0), {20.0, 10.0}};
  EXPECT_EQ(grid.heights, (std::vector<float>{0, 2, 4, 0, 0, 1}));
  const Mesh ground = makeTerrain(grid, 0.0);
  ASSERT_EQ(ground.triangles.size(), 4u);
  // The first row is in the north.
  EXPECT_LT((ground.positions[2] - Eigen::Vector3f(10, 5, 4)).norm(), kTolerance);
  EXPECT_LT((ground.positions[3] - Eigen::Vector3f(-10, -5, 0)).norm(), kTolerance);
  for (const auto& triangle : ground.triangles) EXPECT_GT(faceVector(ground, triangle).z(), 0.0);
  EXPECT_FLOAT_EQ(makeTerrain(grid, 5.0).texture_coordinates[5].x(), 4.0f);
  EXPECT_EQ(terrainHeights(image::Picture<float, 1>(2, 2), 8.0), (std::vector<float>(4, 0.0f)));
  // Elevations, from 10 m below the sea to 30 m above it.
  values.data = {-10.0f, 0.0f, 30.0f, 10.0f, 0.0f, 0.0f};
  EXPECT_EQ(terrainHeights(values, 8.0), (std::vector<float>{0, 2, 8, 4, 2, 2}));
}

class SdfShape : public SceneFiles {
 protected:
  Scene loaded(const std::string& content, Missing missing = Missing::kStop) const {
    SearchPath search_path;
    search_path.missing = missing;
    return load(write("test.world", "<sdf version='1.6'><world name='w'>" + content + "</world></sdf>"),
                search_path);
  }
  static std::string visual(const std::string& geometry) {
    return "<model name='m'><pose>100 0 0 0 0 0</pose><link name='l'><visual name='v'><geometry>" + geometry +
           "</geometry></visual></link></model>";
  }
  /// `side` × `side` px of one colour, or of grey that rises to the east.
  void writePicture(const std::string& name, int side, int red, int green) const {
    image::Rgba8Image picture(side, side);
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        std::uint8_t* texel = picture.at(x, y);
        texel[0] = static_cast<std::uint8_t>(red >= 0 ? red : 255 * x / (side - 1));
        texel[1] = static_cast<std::uint8_t>(red >= 0 ? green : texel[0]);
        texel[2] = static_cast<std::uint8_t>(red >= 0 ? 0 : texel[0]);
        texel[3] = 255;
      }
    }
    write(name, image::encodePng(picture));
  }
};

TEST_F(SdfShape, PolylinesAreSolidsWithHoles) {
  const std::string loops =
      "<polyline><point>0 0</point><point>4 0</point><point>4 4</point><point>0 "
      "4</point><height>2</height></polyline>"
      "<polyline><point>1 1</point><point>3 1</point><point>3 3</point><point>1 "
      "3</point><height>2</height></polyline>";
  const Scene scene = loaded(visual(loops));
  ASSERT_EQ(scene.meshes.size(), 1u);
  Mesh mesh = scene.meshes[0];
  for (Eigen::Vector3f& position : mesh.positions) position.x() -= 100.0f;  // or volumes lose digits
  EXPECT_NEAR(volumeOf(mesh), 2.0 * (16.0 - 4.0), kTolerance);
  EXPECT_TRUE(scene.warnings.empty());
  const auto errorOfWorld = [&](const std::string& content) {
    return errorOf(write("test.world", "<sdf version='1.6'><world name='w'>" + content + "</world></sdf>"));
  };
  EXPECT_EQ(errorOfWorld(visual("<polyline><point>0 0</point><height>0</height></polyline>")),
            pathOf("test.world") + ": visual m::l::v: its height is 0, but must be above 0 m");
  EXPECT_EQ(errorOfWorld("<road name='r'><width>-0</width><point>0 0 0</point><point>9 0 0</point></road>"),
            pathOf("test.world") + ": road r: its width is -0, but must be above 0 m");
}

TEST_F(SdfShape, RoadsAreRibbons) {
  const Scene scene = loaded(
      "<road name='street'><width>6</width><point>0 0 0.01</point><point>30 0 0.01</point></road>"
      "<road name='path'><width>2</width><point>0 50 0</point><point>0 60 0</point>"
      "<material><script><name>Gazebo/Red</name></script></material></road>"
      "<road name='dot'><width>2</width><point>0 0 0</point></road>");
  ASSERT_EQ(scene.meshes.size(), 2u);
  EXPECT_EQ(scene.meshes[0].name, "street");
  EXPECT_NEAR(areaOf(scene.meshes[0]), 180.0, kTolerance);
  EXPECT_NEAR(areaOf(scene.meshes[1]), 20.0, kTolerance);
  EXPECT_EQ(scene.meshes[0].normals[0], Eigen::Vector3f(0, 0, 1));
  EXPECT_EQ(scene.materials.at(static_cast<std::size_t>(scene.meshes[1].material)).base_color.value[0], 1.0f);
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_EQ(scene.warnings[0], "1 roads have less than two points, they were left out: dot");
}

TEST_F(SdfShape, AHeightMapIsGround) {
  writePicture("hills.png", 5, -1, 0);
  const Scene scene =
      loaded(visual("<heightmap><uri>hills.png</uri><size>40 20 8</size><pos>0 0 1</pos></heightmap>"));
  ASSERT_EQ(scene.meshes.size(), 1u);
  EXPECT_LT((boundsOf(scene).min() - Eigen::Vector3f(-20, -10, 1)).norm(), kTolerance);
  EXPECT_LT((boundsOf(scene).max() - Eigen::Vector3f(20, 10, 9)).norm(), kTolerance);
  // Steps of 63, 64, 64 and 64 of 255 are even to 1 %.
  EXPECT_NEAR(nearestOnVertical(scene, {0, 3, 5})->z, 5.0, 0.01 * 8.0);
}

// As Gazebo does, whose 1 is a metre, however high the land is.
TEST_F(SdfShape, AHeightMapOfANegativeHeightIsTurnedOver) {
  writePicture("hills.png", 5, -1, 0);
  const Scene scene =
      loaded(visual("<heightmap><uri>hills.png</uri><size>40 20 -8</size><pos>0 0 3</pos></heightmap>"));
  EXPECT_NEAR(boundsOf(scene).max().z(), 3.0f + 1.0f, kTolerance);
  EXPECT_NEAR(boundsOf(scene).min().z(), 3.0f + 1.0f - 8.0f, kTolerance);
  const auto rising = loaded(visual("<heightmap><uri>hills.png</uri><size>40 20 8</size></heightmap>"));
  ASSERT_EQ(scene.meshes.at(0).positions.size(), rising.meshes.at(0).positions.size());
  for (std::size_t i = 0; i < rising.meshes[0].positions.size(); ++i)
    EXPECT_NEAR(scene.meshes[0].positions[i].z(), 4.0f - rising.meshes[0].positions[i].z(), kTolerance) << i;
}

TEST_F(SdfShape, AHeightMapWithoutASizeIsOfAMetreAndNamed) {
  writePicture("hills.png", 5, -1, 0);
  const auto namedIn = [&](const std::string& size) {
    const Scene scene = loaded(visual("<heightmap><uri>hills.png</uri>" + size + "</heightmap>"));
    EXPECT_NEAR(boundsOf(scene).sizes().x(), size.empty() ? 1.0f : 40.0f, kTolerance);
    return std::count(scene.warnings.begin(), scene.warnings.end(),
                      "1 height maps without a <size> are taken as 1 × 1 × 1 m, elevation models need one, "
                      "too: m::l::v");
  };
  EXPECT_EQ(namedIn(""), 1);
  EXPECT_EQ(namedIn("<size>40 20 8</size>"), 0);
}

TEST_F(SdfShape, AHeightMapHasAVertexForEachPixelWhateverItsSampling) {
  writePicture("hills.png", 5, -1, 0);
  const auto with = [&](const std::string& sampling) {
    return loaded(visual("<heightmap><uri>hills.png</uri><size>40 20 8</size>" + sampling + "</heightmap>"));
  };
  const Scene plain = with("");
  EXPECT_EQ(plain.triangleCount(), 2u * 4u * 4u);
  for (const std::string sampling : {"2", "16", "-1"}) {
    const Scene scene = with("<sampling>" + sampling + "</sampling>");
    EXPECT_EQ(scene.meshes[0].positions, plain.meshes[0].positions);
    ASSERT_EQ(scene.warnings.size(), plain.warnings.size() + 1) << sampling;
    EXPECT_NE(scene.warnings[0].find("<sampling>") == std::string::npos,
              scene.warnings.back().find("<sampling>") == std::string::npos);
  }
}

TEST_F(SdfShape, PixelsOfAHeightMapWithoutAHeightAreFilledAndCounted) {
  cv::Mat heights(5, 5, CV_32FC1);
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 5; ++x) heights.at<float>(y, x) = 100.0f + 50.0f * static_cast<float>(x);
  }
  heights.at<float>(0, 4) = -9999.0f;
  heights.at<float>(1, 4) = std::numeric_limits<float>::quiet_NaN();
  std::vector<unsigned char> bytes;
  ASSERT_TRUE(cv::imencode(".tiff", heights, bytes));
  const std::string file = write("land.tiff", {bytes.begin(), bytes.end()});
  const Scene scene =
      loaded(visual("<heightmap><uri>land.tiff</uri><size>40 20 8</size><pos>0 0 1</pos></heightmap>"));
  EXPECT_LT((boundsOf(scene).min() - Eigen::Vector3f(-20, -10, 1)).norm(), kTolerance);
  EXPECT_LT((boundsOf(scene).max() - Eigen::Vector3f(20, 10, 9)).norm(), kTolerance);
  EXPECT_NEAR(nearestOnVertical(scene, {0, -3, 12})->z, 5.0, kTolerance);
  EXPECT_EQ(std::count(scene.warnings.begin(), scene.warnings.end(),
                       "1 height maps have pixels without a height, the lowest of the others stands for "
                       "them: m::l::v, 2 of " +
                           file),
            1);
}

TEST_F(SdfShape, AHeightMapStandsAtItsPosAlone) {
  writePicture("hills.png", 5, -1, 0);
  const Scene scene = loaded(visual("<heightmap><uri>hills.png</uri><size>40 20 8</size></heightmap>"));
  EXPECT_FLOAT_EQ(boundsOf(scene).max().x(), 20.0f);
  EXPECT_EQ(scene.warnings,
            (std::vector<std::string>{
                "1 height maps stand where their <pos> says, not where their models do, as in "
                "Gazebo: m::l::v"}));
}

TEST_F(SdfShape, LayersOfAHeightMapAreMixedByHeight) {
  writePicture("hills.png", 129, -1, 0);
  writePicture("sand.png", 8, 200, 0);
  writePicture("grass.png", 8, 0, 100);
  const std::string layers =
      "<texture><diffuse>sand.png</diffuse><normal>none.png</normal><size>4</size></texture>"
      "<texture><diffuse>grass.png</diffuse><normal>none.png</normal><size>2</size></texture>"
      "<blend><min_height>2</min_height><fade_dist>4</fade_dist></blend>";
  const Scene scene =
      loaded(visual("<heightmap><uri>hills.png</uri><size>40 40 8</size>" + layers + "</heightmap>"));
  ASSERT_EQ(scene.textures.size(), 1u);
  const Texture& texture = scene.textures[0];
  const auto red = [&](double share_east) {
    const auto x = static_cast<std::size_t>(share_east * texture.width);
    return static_cast<int>(texture.rgba[4 * (x + static_cast<std::size_t>(texture.width) * 7)]);
  };
  EXPECT_EQ(red(0.1), 200);              // at 0.8 m
  EXPECT_EQ(red(0.9), 0);                // at 7.2 m
  ASSERT_EQ(scene.warnings.size(), 1u);  // of its place
  // Half way up, half the light: sRGB of half of what 200 is, 0.5 · ((200/255 + 0.055) / 1.055)^2.4, is 147.
  EXPECT_NEAR(red(0.5), 147, 2);  // a texel and a grey level beside the middle
  // One layer alone is no picture of its own, but repeated.
  const Scene one =
      loaded(visual("<heightmap><uri>hills.png</uri><size>40 40 8</size><texture><diffuse>sand.png</diffuse>"
                    "<normal/><size>4</size></texture></heightmap>"));
  EXPECT_EQ(one.textures.at(0).width, 8);
  EXPECT_FLOAT_EQ(one.meshes[0].texture_coordinates.back().x(), 10.0f);
}

// As makeTerrain() has a single one: a tile is square, whatever its picture is.
TEST_F(SdfShape, LayersOfAHeightMapAreSquareWhateverTheirPictures) {
  for (const auto& [width, height] : {std::pair{8, 4}, {4, 8}}) {
    image::Rgba8Image halves(width, height);  // red above, green below
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) halves.at(x, y)[2 * y < height ? 0 : 1] = 255;
    }
    TerrainLayer layer;
    layer.file = write("halves.png", image::encodePng(halves));
    layer.tile_m = 4.0;
    const image::Rgba8Image baked =
        bakedLayers({2, 2, std::vector<float>(4, 0.0f), {40.0, 40.0}}, {layer}, 80);
    for (int y = 0; y < 80; ++y) EXPECT_EQ(baked.at(11, y)[0], y % 8 < 4 ? 255 : 0) << y;
  }
}

TEST_F(SdfShape, NormalMapsOfHeightMapsAreNamedUnlessTheyAreFlat) {
  writePicture("hills.png", 5, -1, 0);
  writePicture("bumps.png", 8, 128, 128);
  writePicture("flat_normal.png", 8, 128, 128);
  const auto named = [&](const std::string& normal) {
    const Scene scene = loaded(
        visual("<heightmap><uri>hills.png</uri><size>40 40 8</size><texture><diffuse>bumps.png</diffuse>"
               "<normal>" +
               normal + "</normal><size>4</size></texture></heightmap>"));
    return std::count_if(scene.warnings.begin(), scene.warnings.end(), [](const std::string& warning) {
      return warning.find("its normal map bumps.png: without it") != std::string::npos;
    });
  };
  EXPECT_EQ(named("bumps.png"), 1);
  EXPECT_EQ(named("flat_normal.png"), 0);
  EXPECT_EQ(named(""), 0);
}

TEST_F(SdfShape, WhatIsNotThereOrNotDrawnIsNamed) {
  const std::string map = visual("<heightmap><uri>gone.png</uri></heightmap>");
  const std::string file =
      write("test.world", "<sdf version='1.6'><world name='w'>" + map + "</world></sdf>");
  EXPECT_EQ(
      errorOf(file).find(file + ": visual m::l::v: there is no height map gone.png; it was looked for as "),
      0u)
      << errorOf(file);
  const std::string box =
      "<model name='n'><link name='l'><visual name='v'><geometry><box><size>1 1 1</size></box>"
      "</geometry></visual><visual name='p'><geometry><image><uri>x.png</uri></image></geometry>"
      "</visual></link></model>";
  const Scene scene = loaded(map + box, Missing::kWarn);
  EXPECT_EQ(scene.triangleCount(), 12u);
  ASSERT_EQ(scene.warnings.size(), 2u);
  EXPECT_EQ(scene.warnings[0].find("1 height maps are missing or cannot be read and were left out: " + file),
            0u);
  EXPECT_EQ(scene.warnings[1], "1 visuals have no shape that can be drawn: n::l::p (an <image>)");
}

TEST(TwoBoxes, AreTheSameAsSdfAndAsUrdf) {
  const std::string file = SUNLIT_SOURCE_DIR "/test/support/worlds/two_boxes.";
  const Scene sdf = load(file + "world", {}), urdf = load(file + "urdf", {});
  ASSERT_EQ(sdf.meshes.size(), 3u);
  ASSERT_EQ(urdf.meshes.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const Mesh &a = sdf.meshes[i], &b = urdf.meshes[i];
    EXPECT_TRUE(boundsOf(a).isApprox(boundsOf(b), 1e-6f)) << a.name;
    EXPECT_NEAR(volumeOf(a), volumeOf(b), 1e-6 * volumeOf(a)) << a.name;
    const auto colour = [](const Scene& scene, const Mesh& mesh) {
      return scene.materials[static_cast<std::size_t>(mesh.material)].base_color.value;
    };
    EXPECT_TRUE((colour(sdf, a) == colour(urdf, b)).all()) << a.name;
  }
}

}  // namespace
}  // namespace sunlit::scene
