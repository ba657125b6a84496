/// Stars as files of Debian have them, and what becomes of files that are missing or broken.
#include "sunlit/astronomy/star_catalogue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "sunlit/astronomy/celestial.h"
#include "support/message_of.h"

namespace sunlit::astronomy {
namespace {

namespace fs = std::filesystem;

/// A folder of its own for the files of one test.
struct StarFiles : testing::Test {
  StarFiles()
      : folder(
            fs::path(testing::TempDir()) /
            (std::string("sunlit_stars_") + testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::create_directories(folder);
  }
  ~StarFiles() override { fs::remove_all(folder); }

  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder / name) << text;
    return (folder / name).string();
  }
  std::string faultOf(const StarCatalogueFiles& files) const {
    return messageOf<std::runtime_error>([&] { readStarCatalogue(files); });
  }

  const fs::path folder;
};

TEST_F(StarFiles, PlacesAreReadAndSortedByBrightness) {
  const std::string places = write("places",
                                   "# a comment\n\n"
                                   " 38.7836 18.6156  0.03 \"  3Alp Lyr\" 7001 172167  67174\n"
                                   "-16.7161  6.7525 -1.46 \"  9Alp CMa\" 2491  48915 151881\n"
                                   " 10.0      0.0     5.0\n");
  const StarCatalogue catalogue = readStarCatalogue({places, ""});
  EXPECT_TRUE(catalogue.warnings.empty());
  ASSERT_EQ(catalogue.stars.size(), 3u);
  EXPECT_EQ(catalogue.stars[0].v_magnitude, -1.46);
  EXPECT_EQ(catalogue.stars[2].v_magnitude, 5.0);
  const Eigen::Vector3d sirius = equatorial(Angle::degrees(6.7525 * 15.0), Angle::degrees(-16.7161));
  EXPECT_LT((catalogue.stars[0].towards - sirius).norm(), 1e-15);
  EXPECT_EQ(catalogue.stars[0].b_minus_v, 0.0);           // by its number
  EXPECT_TRUE(std::isnan(catalogue.stars[2].b_minus_v));  // nobody knows
}

TEST_F(StarFiles, TypesGiveColours) {
  const std::string places = write("places", "20.0 6.0 3.00\n-20.0 6.0 4.00\n20.0 6.1 3.0\n");
  // 6 h is π/2 rad. Another right ascension, another magnitude: another star.
  const std::string types = write("types",
                                  "# a comment\nA,1.570800,0.1,3.05,K5\nB,1.570750,0.1,3.95,A0\n"
                                  "C,1.600000,0.1,3.00,M0\n");
  const std::vector<CatalogueStar> stars = readStarCatalogue({places, types}).stars;
  ASSERT_EQ(stars.size(), 3u);
  EXPECT_EQ(stars[0].b_minus_v, 1.50);
  EXPECT_TRUE(std::isnan(stars[1].b_minus_v));
  EXPECT_NEAR(stars[2].b_minus_v, -0.02, 1e-12);
}

TEST_F(StarFiles, MissingFilesAreWarningsThatNameTheirPackages) {
  const StarCatalogue none = readStarCatalogue({(folder / "no").string(), ""});
  EXPECT_TRUE(none.stars.empty());
  ASSERT_EQ(none.warnings.size(), 1u);
  EXPECT_NE(none.warnings[0].find((folder / "no").string()), std::string::npos);
  EXPECT_NE(none.warnings[0].find("Debian package xplanet"), std::string::npos);

  const StarCatalogue white = readStarCatalogue({write("places", "1 2 3\n"), (folder / "no").string()});
  EXPECT_EQ(white.stars.size(), 1u);
  ASSERT_EQ(white.warnings.size(), 1u);
  EXPECT_NE(white.warnings[0].find("Debian package openuniverse-common"), std::string::npos);

  EXPECT_TRUE(readStarCatalogue({"", ""}).warnings.empty());  // as asked for
}

TEST_F(StarFiles, BrokenLinesAreNamed) {
  const auto faultOfPlaces = [&](const std::string& line) {
    return faultOf({write("places", "1.0 2.0 3.0\n" + line + "\n"), ""});
  };
  const std::string where = (folder / "places").string() + ":2: ";
  EXPECT_EQ(faultOfPlaces("10.0 north 3.0"),
            where + "is no star: declination, right ascension and magnitude are expected");
  EXPECT_EQ(faultOfPlaces("10.0 3.0"),
            where + "is no star: declination, right ascension and magnitude are expected");
  EXPECT_EQ(faultOfPlaces("91.0 3.0 4.0"), where + "declination is 91, but must be from -90 to 90 deg");
  EXPECT_EQ(faultOfPlaces("10.0 25.0 4.0"), where + "right ascension is 25, but must be from 0 to 24 h");
  EXPECT_EQ(faultOfPlaces("10.0 3.0 99.0"), where + "magnitude is 99, but must be from -30 to 30");

  const std::string places = write("places", "1.0 2.0 3.0\n");
  const std::string types = (folder / "types").string();
  EXPECT_EQ(faultOf({places, write("types", "A,1.0,2.0,3.0\n")}), types + ":1: has 4 fields instead of 5");
  EXPECT_EQ(faultOf({places, write("types", "A,x,2.0,3.0,K0\n")}),
            types + ":1: has no numbers for right ascension and magnitude");
}

TEST(SpectralTypes, RedderTheCooler) {
  double last = -1.0;
  for (const char* type : {"O9", "B0", "B5", "A0", "A5", "F0", "F5", "G0", "G5", "K0", "K5", "M0", "M9"}) {
    EXPECT_GT(bMinusVOfType(type), last) << type;
    last = bMinusVOfType(type);
  }
  EXPECT_NEAR(bMinusVOfType("K2"), 1.2, 1e-12);  // between K0 and K5
  EXPECT_EQ(bMinusVOfType("O0"), -0.33);
  for (const char* other : {"", "K", "Kx", "S5", "C3"})
    EXPECT_TRUE(std::isnan(bMinusVOfType(other))) << other;
}

TEST(StarCatalogue, OfDebianHasTheStarsThatEyesSee) {
  const StarCatalogue catalogue = readStarCatalogue();
  if (!catalogue.warnings.empty()) GTEST_SKIP() << catalogue.warnings[0];
  // 9,096 stars in the catalogue; magnitude 6.5 is its aim.
  EXPECT_GT(catalogue.stars.size(), 9000u);
  ASSERT_TRUE(std::is_sorted(catalogue.stars.begin(), catalogue.stars.end(),
                             [](const auto& a, const auto& b) { return a.v_magnitude < b.v_magnitude; }));
  EXPECT_EQ(catalogue.stars[0].v_magnitude, -1.46);  // Sirius
  const auto brighter = std::count_if(catalogue.stars.begin(), catalogue.stars.end(),
                                      [](const auto& star) { return star.v_magnitude <= 6.0; });
  // The eye sees about 5,000 on the whole sphere.
  EXPECT_NEAR(static_cast<double>(brighter), 5000.0, 150.0);

  std::size_t coloured = 0;
  for (std::size_t i = 0; i < 500; ++i) coloured += !std::isnan(catalogue.stars[i].b_minus_v);
  std::printf("%zu stars, %zu of the 500 brightest with a colour\n", catalogue.stars.size(), coloured);
  EXPECT_GT(coloured, 400u);

  // Orion's shoulder is red, his foot is blue.
  const auto colourAt = [&](double right_ascension_h, double declination_deg) {
    const Eigen::Vector3d there =
        equatorial(Angle::degrees(15.0 * right_ascension_h), Angle::degrees(declination_deg));
    for (const CatalogueStar& star : catalogue.stars)
      if ((star.towards - there).norm() < 1e-4) return star.b_minus_v;
    return std::nan("");
  };
  EXPECT_NEAR(colourAt(5.9195, 7.4069), 1.85, 0.01);
  EXPECT_NEAR(colourAt(5.2423, -8.2017), -0.03, 0.01);
  EXPECT_NEAR(colourAt(13.3988, 54.9253), 0.02, 0.1);  // Mizar, A2, by its type
}

}  // namespace
}  // namespace sunlit::astronomy
