#include "sunlit/evaluate/atlas/atlas.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>

#include "sunlit/evaluate/atlas/atlas_files.h"
#include "sunlit/evaluate/localise/localisation.h"
#include "support/message_of.h"
#include "support/temporary_folder.h"
#include "support/textured_scene.h"

namespace sunlit::evaluate {
namespace {

const image::PinholeCamera kCamera{160, 120, 138.5, 138.5, 79.5, 59.5};
const std::vector<std::string> kLights = {"bright", "dim"};
constexpr int kPoses = 3;

AtlasOptions options() {
  AtlasOptions options;
  options.verify.detectors = {"sift", "orb+clahe"};
  options.map_every_m = 1.0;
  options.localiser.pose.min_inliers = 6;
  return options;
}

/// 0.5 m apart along the corridor, so that every other pose is a key frame; the other light is dimmer.
const std::vector<PosedView>& drive(const std::string& light) {
  static const std::vector<std::vector<PosedView>> drives = [] {
    std::vector<std::vector<PosedView>> made(2);
    for (int i = 0; i < kPoses; ++i) {
      made[0].push_back(corridor().seenFrom(lookingAlongX({0.5 * i, 0, 0}), kCamera));
      made[1].push_back(made[0].back());
      made[1].back().picture = makePicture(made[0].back().picture.rgb * 0.3);
    }
    return made;
  }();
  return drives[light == "bright" ? 0 : 1];
}

AtlasView viewOf(int pose, const std::vector<std::string>& lights) {
  AtlasView view;
  view.pose = 10 + pose;
  view.camera = kCamera;
  const PosedView& first = drive("bright")[static_cast<std::size_t>(pose)];
  view.map_from_optical = first.map_from_optical;
  view.depth = image::DepthImage(kCamera.width, kCamera.height);
  std::memcpy(view.depth.data.data(), first.depth.data, view.depth.data.size() * sizeof(float));
  for (const std::string& light : lights) {
    image::Rgb8Image picture(kCamera.width, kCamera.height);
    std::memcpy(picture.data.data(), drive(light)[static_cast<std::size_t>(pose)].picture.rgb.data,
                picture.data.size());
    view.lit.push_back({light, picture, light == "bright" ? 12.0 : 9.5 + pose});
  }
  return view;
}

std::int64_t asObserved(const ObservationKey& key) {
  return key.pose;
}

void observeAll(const std::string& path) {
  const AtlasObserver observer(options());
  ObservationFile file(path);
  for (int pose = 0; pose < kPoses; ++pose) observer.observe(viewOf(pose, kLights), &file);
}

/// What Localisation says of the pictures themselves.
std::vector<LocalisedQuery> localised(const std::string& map, const std::string& query) {
  LocalisationOptions direct;
  direct.detectors = {"sift"};
  direct.localiser = options().localiser;
  Localisation localisation(direct);
  localisation.addKeyFrames({drive(map)[0], drive(map)[2]});
  localisation.finishMap();
  std::vector<LocalisedQuery> found;
  for (const auto& by_detector : localisation.localise(drive(query)).results) found.push_back(by_detector[0]);
  return found;
}

bool same(double a, double b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

void expectAsDirect(const DriveIndex& index, const std::string& map, const std::string& query) {
  const std::vector<LocalisedQuery> direct = localised(map, query);
  for (std::size_t m = 0; m < 2; ++m) {
    const std::string method = options().verify.detectors[m];
    const std::vector<AtlasRow> rows = AtlasMap(index, options(), {map, "", method}).find(query);
    ASSERT_EQ(rows.size(), std::size_t{kPoses});
    for (std::size_t i = 0; i < rows.size(); ++i) {
      EXPECT_EQ(rows[i].pose, 10 + static_cast<std::int64_t>(i));
      const Verified verified =
          verifyImages({drive(map)[i].picture.rgb, drive(query)[i].picture.rgb},
                       identityMaps({kCamera.width, kCamera.height}), options().verify)[m];
      EXPECT_TRUE(same(rows[i].difference, verified.difference.value)) << method << i;
      EXPECT_TRUE(same(rows[i].matching_score, verified.matching_score));
      EXPECT_TRUE(same(rows[i].precision, verified.precision));
      EXPECT_EQ(rows[i].ev100, query == "bright" ? 12.0 : 9.5 + static_cast<double>(i));
      if (method != "sift") continue;
      EXPECT_EQ(rows[i].status, direct[i].status);
      EXPECT_TRUE(same(rows[i].error_m, direct[i].error_m)) << rows[i].error_m << " " << direct[i].error_m;
      EXPECT_TRUE(same(rows[i].error_deg, direct[i].error_deg));
      EXPECT_EQ(rows[i].inliers, direct[i].estimate.inliers.size());
    }
  }
}

TEST(Atlas, EveryCellIsWhatThePicturesThemselvesGive) {
  const TemporaryFolder folder;
  observeAll(folder.file("observations"));
  const ObservationFile file(folder.file("observations"), ObservationUse::kRead);
  const DriveIndex index({&file}, asObserved);
  std::size_t localised_queries = 0;
  for (const std::string& map : kLights) {
    for (const std::string& query : kLights) {
      expectAsDirect(index, map, query);
      for (const AtlasRow& row : AtlasMap(index, options(), {map, "", "sift"}).find(query))
        localised_queries += row.status == LocalisationStatus::kLocalised;
    }
  }
  EXPECT_EQ(localised_queries, 12u) << "nothing would be compared";
}

TEST(Atlas, ObservingGoesOnToTheSameBytes) {
  const TemporaryFolder folder;
  observeAll(folder.file("whole"));
  const std::string whole = contentOf(folder.file("whole"));
  EXPECT_EQ(observedWhole(ObservationFile(folder.file("whole")), 2).size(), 6u);
  // Killed within the second picture of the second pose.
  const std::string torn = folder.file("torn");
  std::ofstream(torn, std::ios::binary) << whole.substr(0, whole.size() / 2);
  {
    ObservationFile file(torn);
    const auto before = observedWhole(file, 2);
    EXPECT_LT(before.size(), 4u);
    EXPECT_GE(before.size(), 2u);
    const AtlasObserver observer(options());
    for (int pose = 0; pose < kPoses; ++pose) {
      std::vector<std::string> lights;
      for (const std::string& light : kLights) {
        if (before.count({light, 10 + pose}) == 0) lights.push_back(light);
      }
      observer.observe(viewOf(pose, lights), &file);
    }
  }
  EXPECT_TRUE(contentOf(torn) == whole);
}

TEST(Atlas, DoesNotDependOnTheNumberOfThreads) {
  const TemporaryFolder folder;
  observeAll(folder.file("many"));
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  observeAll(folder.file("one"));
  EXPECT_TRUE(contentOf(folder.file("many")) == contentOf(folder.file("one")));
}

TEST(Atlas, SaysWhatHasNotBeenObserved) {
  const TemporaryFolder folder;
  observeAll(folder.file("observations"));
  const ObservationFile file(folder.file("observations"), ObservationUse::kRead);
  const DriveIndex index({&file}, asObserved);
  EXPECT_EQ(messageOf<std::runtime_error>([&] {
              AtlasMap(index, options(), {"dawn", "", "sift"});
            }),
            "dawn by sift has no observations to make a map of");
  const AtlasMap map(index, options(), {"dim", "", "sift"});
  EXPECT_EQ(messageOf<std::runtime_error>([&] { map.find("dawn"); }), "dawn by sift has 0 poses, but dim 3");
}

TEST(Atlas, AQueryDriveIsLocalisedAndEqualPosesAreCompared) {
  const TemporaryFolder folder;
  const std::string path = folder.file("observations");
  observeAll(path);
  {
    ObservationFile file(path);
    const AtlasObserver observer(options());
    for (int pose = 0; pose < kPoses; ++pose) {  // another order of poses: as if the second drive went back
      AtlasView view = viewOf(kPoses - 1 - pose, {"dim"});
      view.pose = 10 + pose;
      view.lit[0].condition = queryDriveOf("dim");
      view.lit[0].ev100 = -2.0;
      observer.observe(view, &file);
    }
  }
  const ObservationFile file(path, ObservationUse::kRead);
  const DriveIndex index({&file}, asObserved);
  AtlasOptions beside = options();
  beside.has_query_drive = true;
  const std::vector<AtlasRow> one = AtlasMap(index, options(), {"bright", "", "sift"}).find("dim");
  const std::vector<AtlasRow> two = AtlasMap(index, beside, {"bright", "", "sift"}).find("dim");
  for (std::size_t i = 0; i < two.size(); ++i) {
    EXPECT_EQ(two[i].error_m, one[two.size() - 1 - i].error_m);
    EXPECT_EQ(two[i].matching_score, one[i].matching_score);
    EXPECT_EQ(two[i].difference, one[i].difference);
    EXPECT_EQ(two[i].ev100, -2.0);
  }
  EXPECT_EQ(messageOf<std::runtime_error>([&] {
              AtlasMap(index, beside, {"dim", "", "sift"}).find("bright");
            }),
            "bright/query by sift has 0 poses, but dim 3");
}

/// Two of four localised, at 0.1 and 0.4 m; numbers by hand.
std::vector<AtlasRow> fourRows() {
  std::vector<AtlasRow> rows(4);
  rows[0] = {0, LocalisationStatus::kLocalised, 0.1, 1.0, 20, 0.5, 0.25, 1.0, 14.0};
  rows[1] = {1, LocalisationStatus::kLocalised, 0.4, 1.0, 12, 0.7, 0.75, 0.5, 14.0};
  rows[2].pose = 2;
  rows[2].status = LocalisationStatus::kNoPose;
  rows[2].difference = 0.9;
  rows[2].matching_score = 0.0;
  rows[2].ev100 = 13.0;
  rows[3].pose = 3;
  rows[3].status = LocalisationStatus::kNoFeatures;
  rows[3].ev100 = 13.0;
  return rows;
}

TEST(Atlas, ACellCountsFailuresAndWhatIsUndefined) {
  const AtlasCell cell = cellOf({"a", "b", "sift"}, fourRows());
  EXPECT_EQ(cell.n, 4u);
  EXPECT_EQ(cell.failures, 2u);
  EXPECT_DOUBLE_EQ(cell.within[0].mean, 0.25);
  const AtlasCell lost = cellOf({"m", "q", "sift"}, std::vector<AtlasRow>(10));
  EXPECT_EQ(lost.within[0].mean, 0.0);
  EXPECT_NEAR(lost.within[0].ci_high, 0.2775, 5e-5) << "none of ten is no certainty";
  EXPECT_DOUBLE_EQ(cell.within[1].mean, 0.5);
  EXPECT_DOUBLE_EQ(cell.within[2].mean, 0.5);
  EXPECT_TRUE(std::isinf(cell.median_error_m)) << "half of them are failures";
  EXPECT_DOUBLE_EQ(cell.difference.mean, 0.7);
  EXPECT_EQ(cell.difference.undefined, 1u);
  EXPECT_DOUBLE_EQ(cell.matching_score.mean, 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(cell.precision.mean, 0.75);
  EXPECT_EQ(cell.precision.undefined, 2u);
}

TEST(AtlasFiles, RowsComeBackToTheBit) {
  const TemporaryFolder folder;
  const std::string path = folder.file("cell.csv");
  std::vector<AtlasRow> rows = fourRows();
  rows[0].error_m = 0.1 + 1e-17 + 1.0 / 3.0;
  writeAtlasRows(path, rows);
  const std::string text = contentOf(path);
  EXPECT_EQ(text.substr(0, text.find('\n')),
            "pose,status,error_m,error_deg,inliers,d,matching_score_3px,precision_3px,ev100");
  const std::vector<AtlasRow> read = readAtlasRows(path);
  ASSERT_EQ(read.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(read[i].pose, rows[i].pose);
    EXPECT_EQ(read[i].status, rows[i].status);
    EXPECT_TRUE(same(read[i].error_m, rows[i].error_m));
    EXPECT_TRUE(same(read[i].difference, rows[i].difference));
    EXPECT_EQ(read[i].inliers, rows[i].inliers);
    EXPECT_EQ(read[i].ev100, rows[i].ev100);
  }
  std::ofstream(path) << text.substr(0, text.size() - 3);
  EXPECT_NE(messageOf<std::runtime_error>([&] { readAtlasRows(path); }).find("is not whole"),
            std::string::npos);
  std::ofstream(path) << text.substr(0, text.find('\n') + 1) + "0,lost,1,1,1,1,1,1,1\n";
  EXPECT_EQ(messageOf<std::runtime_error>([&] { readAtlasRows(path); }), path + ":2: \"lost\" is no status");
}

TEST(AtlasFiles, TheTableHasARowACell) {
  const TemporaryFolder folder;
  const auto file_of = [&](const AtlasCellKey& key) { return folder.file(key.map + key.query); };
  writeAtlasRows(file_of({"a", "b", ""}), fourRows());
  writeAtlasRows(file_of({"a", "a", ""}), {fourRows()[0], fourRows()[1]});
  const AtlasSummary summary = summariseAtlas({{"a", "b", "sift"}, {"a", "a", "sift"}}, file_of);
  EXPECT_DOUBLE_EQ(summary.ev100.at("b"), 13.5);
  EXPECT_DOUBLE_EQ(summary.ev100.at("a"), 14.0);
  writeAtlas(folder.file("atlas.csv"), summary.cells);
  const std::string text = contentOf(folder.file("atlas.csv"));
  EXPECT_EQ(text.substr(0, text.find('\n')),
            "map,query,method,n,failures,within_0.25m_2deg,within_0.25m_2deg_low,within_0.25m_2deg_high,"
            "within_0.5m_5deg,within_0.5m_5deg_low,within_0.5m_5deg_high,within_5m_10deg,within_5m_10deg_low,"
            "within_5m_10deg_high,median_error_m,median_error_deg,d,d_low,d_high,d_undefined,"
            "matching_score_3px,matching_score_3px_low,matching_score_3px_high,matching_score_3px_undefined,"
            "precision_3px,precision_3px_low,precision_3px_high,precision_3px_undefined");
  EXPECT_NE(text.find("\na,b,sift,4,2,0.25,"), std::string::npos);
  EXPECT_NE(text.find("\na,a,sift,2,0,0.5,"), std::string::npos);
}

}  // namespace
}  // namespace sunlit::evaluate
