#include "sunlit/evaluate/places/place_comparison.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <set>

#include "sunlit/evaluate/places/place_files.h"
#include "support/message_of.h"
#include "support/temporary_folder.h"

namespace sunlit::evaluate {
namespace {

constexpr int kPictures = 14;

/// Blobs of many sizes, so that every detector finds some hundred features.
cv::Mat blobs(int seed, cv::Size size = {200, 150}) {
  cv::RNG generator(static_cast<std::uint64_t>(seed) + 1);
  cv::Mat picture(size, CV_8UC3, cv::Scalar::all(128));
  for (int i = 0; i < 150; ++i) {
    const cv::Point at(generator.uniform(0, size.width), generator.uniform(0, size.height));
    cv::circle(picture, at, generator.uniform(2, 14), cv::Scalar::all(generator.uniform(0, 256)), cv::FILLED);
  }
  return picture;
}

std::string viewName(int i) {
  return "view_" + std::to_string(i) + ".png";
}

class PlacesTest : public ::testing::Test {
 protected:
  std::string folderOf(const std::string& name, int pictures) {
    const std::string path = folder_.file(name);
    std::filesystem::create_directory(path);
    for (int i = 0; i < pictures; ++i) cv::imwrite(path + "/" + viewName(i), blobs(i));
    return path;
  }
  static FoundPlaces find(const std::string& method, const std::string& map, const std::string& queries) {
    PlaceComparison comparison(openPictureFolder(map), openPictureFolder(queries), nullptr);
    return comparison.find(placeMethod(method));
  }
  TemporaryFolder folder_;
};

TEST_F(PlacesTest, AreAllFoundAmongThemselves) {
  const std::string map = folderOf("map", kPictures);
  for (const PlaceMethod& method : allPlaceMethods()) {
    const FoundPlaces found = find(method.name(), map, map);
    const PlaceScores scores = placeScores(found.distances, found.guesses, 0);
    EXPECT_EQ(scores.queries, static_cast<std::size_t>(kPictures)) << method.name();
    EXPECT_EQ(scores.recall_1, 1.0) << method.name();
    EXPECT_EQ(scores.recall_10, 1.0) << method.name();
    EXPECT_EQ(scores.pr_auc, 1.0) << method.name();
    EXPECT_EQ(scores.recall_at_100_precision, 1.0) << method.name();
    EXPECT_TRUE(found.notes.empty()) << method.name() << ": " << found.notes[0];
  }
}

TEST_F(PlacesTest, AreNotFoundInADriveOfOtherPlaces) {
  const std::string map = folderOf("map", kPictures);
  std::filesystem::create_directory(folder_.file("other"));
  for (int i = 0; i < kPictures; ++i) cv::imwrite(folder_.file("other/" + viewName(i)), blobs(100 + i));
  for (const std::string method : {"sad", "vlad:sift"}) {
    const FoundPlaces found = find(method, map, folder_.file("other"));
    // By chance one of 14 is right; six or more with a probability of 1e-4.
    EXPECT_LT(placeScores(found.distances, found.guesses, 0).recall_1, 0.4) << method;
  }
}

TEST_F(PlacesTest, DoNotDependOnTheNumberOfThreads) {
  const std::string map = folderOf("map", 12);
  for (const PlaceMethod& method : allPlaceMethods()) {
    const FoundPlaces many = find(method.name(), map, map);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const int threads = cv::getNumThreads();
    cv::setNumThreads(1);
    const FoundPlaces few = find(method.name(), map, map);
    cv::setNumThreads(threads);
    EXPECT_TRUE((many.distances.array() == few.distances.array()).all()) << method.name();
    for (std::size_t i = 0; i < few.guesses.size(); ++i)
      EXPECT_EQ(many.guesses[i].doubt, few.guesses[i].doubt) << method.name();
  }
}

TEST_F(PlacesTest, AreFoundInPicturesOfAnotherSizeAndKind) {
  const std::string map = folderOf("map", kPictures);
  std::filesystem::create_directory(folder_.file("larger"));
  for (int i = 0; i < kPictures; ++i) {
    cv::Mat larger;
    cv::resize(blobs(i), larger, {}, 1.5 + 0.1 * i, 1.5, cv::INTER_AREA);
    cv::imwrite(folder_.file("larger/" + std::to_string(i) + ".JPG"), larger);
  }
  const FoundPlaces found = find("sad", map, folder_.file("larger"));
  EXPECT_EQ(placeScores(found.distances, found.guesses, 0).recall_1, 1.0);
}

TEST_F(PlacesTest, WithoutFeaturesAreCountedAndNeverFound) {
  const std::string map = folderOf("map", 3);
  const std::string queries = folderOf("queries", 3);
  const cv::Mat wall(150, 200, CV_8UC3, cv::Scalar::all(90));
  cv::imwrite(map + "/" + viewName(1), wall);
  cv::imwrite(queries + "/" + viewName(1), wall);
  const FoundPlaces found = find("vlad:sift", map, queries);
  EXPECT_FALSE(found.guesses[1].place);
  EXPECT_TRUE(std::isinf(found.distances(1, 1)));
  EXPECT_TRUE(std::isinf(found.distances(0, 1)));
  ASSERT_EQ(found.notes.size(), 1u);
  EXPECT_EQ(
      found.notes[0],
      "1 of 3 pictures of the map and 1 of 3 queries have no features: such a place is never found, such a "
      "query finds nothing");
  const PlaceScores scores = placeScores(found.distances, found.guesses, 0);
  EXPECT_EQ(scores.recall_10, 2.0 / 3.0);
  EXPECT_EQ(scores.without_guess, 1u);
  // All 32 patches of both walls, and of no other picture.
  const FoundPlaces by_thumbnails = find("sad", map, queries);
  ASSERT_EQ(by_thumbnails.notes.size(), 1u);
  EXPECT_EQ(by_thumbnails.notes[0],
            "32 of 96 patches of the map and 32 of 96 patches of the queries are constant and count as 0");
  EXPECT_EQ(by_thumbnails.distances(1, 1), 0.0);
}

TEST_F(PlacesTest, CannotBeLearntFromAMapWithoutFeatures) {
  std::filesystem::create_directory(folder_.file("walls"));
  cv::imwrite(folder_.file("walls/a.png"), cv::Mat(50, 50, CV_8UC1, cv::Scalar(7)));
  const std::string said =
      messageOf([&] { find("vlad:sift", folder_.file("walls"), folder_.file("walls")); });
  EXPECT_EQ(said,
            "different descriptors of the map are 0, but must be at least 64, one for each visual word");
}

TEST_F(PlacesTest, NameAPictureThatCannotBeRead) {
  const std::string map = folderOf("map", 2);
  const std::string bytes = contentOf(map + "/" + viewName(1));
  setContent(map + "/" + viewName(1), bytes.substr(0, bytes.size() / 2));
  for (const std::string method : {"sad", "vlad:orb"}) {
    EXPECT_EQ(messageOf<std::runtime_error>([&] { find(method, map, map); }),
              map + "/view_1.png: read: the file is cut off");
  }
  setContent(map + "/" + viewName(1), "no picture");
  EXPECT_EQ(messageOf<std::runtime_error>([&] {
              find("sad", map, map);
            }).rfind(map + "/view_1.png: cannot decode this picture", 0),
            0u);
  std::filesystem::remove(map + "/" + viewName(1));
  cv::imwrite(map + "/x.jpg", blobs(1));
  const std::string jpeg = contentOf(map + "/x.jpg");
  setContent(map + "/x.jpg", jpeg.substr(0, jpeg.size() / 2));
  EXPECT_EQ(messageOf<std::runtime_error>([&] { find("sad", map, map); }),
            map + "/x.jpg: read: the file is cut off");
  // A marker amid the data, which ends them: decoders make up the rest.
  std::string damaged = jpeg;
  damaged[2 * jpeg.size() / 3] = '\xff';
  damaged[2 * jpeg.size() / 3 + 1] = '\xd9';
  setContent(map + "/x.jpg", damaged);
  EXPECT_EQ(messageOf<std::runtime_error>([&] { find("sad", map, map); }),
            map + "/x.jpg: read: damaged JPEG");
}

TEST_F(PlacesTest, OfSeqSlamNeedAWholeSequence) {
  const std::string ten = folderOf("ten", 10), nine = folderOf("nine", 9), eight = folderOf("eight", 8);
  const std::string many = folderOf("many", 11);
  EXPECT_EQ(messageOf([&] { find("seqslam", many, ten); }),
            ten + ": holds 10 pictures, but a sequence of seqslam needs at least 11");
  EXPECT_EQ(messageOf([&] { find("seqslam", eight, many); }),
            eight + ": holds 8 pictures, but a sequence of seqslam needs at least 9");
  EXPECT_EQ(find("seqslam", nine, many).guesses.size(), 11u);
}

TEST_F(PlacesTest, TellHowFarTheyAre) {
  const std::string map = folderOf("map", 3);
  std::set<std::string> works;
  std::size_t calls = 0, last = 0;
  const PictureFolder pictures = openPictureFolder(map);
  PlaceComparison comparison(pictures, pictures,
                             [&](const std::string& work, std::size_t done, std::size_t all) {
                               works.insert(work);
                               ++calls;
                               last = done;
                               EXPECT_EQ(all, 3u);
                             });
  comparison.find(placeMethod("sad"));
  comparison.find(placeMethod("sad"));  // thumbnails are there already
  EXPECT_EQ(works, (std::set<std::string>{"thumbnails of the map", "thumbnails of the queries"}));
  EXPECT_EQ(calls, 6u);
  EXPECT_EQ(last, 3u);
}

TEST(PlaceMethods, AreFoundByTheirNames) {
  for (const PlaceMethod& method : allPlaceMethods())
    EXPECT_EQ(placeMethod(method.name()).name(), method.name());
  const std::string said = messageOf([] { placeMethod("vlad", "--method"); });
  EXPECT_EQ(said.find("--method is \"vlad\", but must be one of sad, seqslam, vlad:sift, "), 0u) << said;
}

TEST(PictureNames, AreInTheOrderOfTheirNumbers) {
  for (const auto& [first, second] : {std::pair("a_9.png", "a_10.png"),
                                      {"a_009.png", "a_10.png"},
                                      {"000.png", "1.png"},
                                      {"1.png", "1a.png"},
                                      {"01.png", "1.png"},
                                      {"a1b2.png", "a1b10.png"},
                                      {"18446744073709551617.png", "18446744073709551618.png"},
                                      {"9.png", "a.png"},
                                      {"B.png", "a.png"},
                                      {"a", "a1"}}) {
    EXPECT_TRUE(isNamedBefore(first, second)) << first;
    EXPECT_FALSE(isNamedBefore(second, first)) << first;
    EXPECT_FALSE(isNamedBefore(first, first)) << first;
  }
}

TEST(PictureFolders, HoldPicturesInTheirOrderAndCountOtherFiles) {
  const TemporaryFolder folder;
  for (const std::string name :
       {"10.png", "9.PNG", "11.jpeg", "12.ppm", "notes.txt", ".hidden.png", "below/1.png"})
    setContent(folder.file(name), "");
  const PictureFolder pictures = openPictureFolder(folder.path());
  EXPECT_EQ(pictures.names, (std::vector<std::string>{"9.PNG", "10.png", "11.jpeg", "12.ppm"}));
  EXPECT_EQ(pictures.other_files, 1u);
  EXPECT_EQ(pictures.file(0), folder.file("9.PNG"));
}

TEST(PictureFolders, MustBeThereAndHoldPictures) {
  const TemporaryFolder folder;
  const auto refusal = [](const std::string& path) {
    return messageOf<std::runtime_error>([&] { openPictureFolder(path); });
  };
  EXPECT_EQ(refusal(folder.file("none")), folder.file("none") + ": there is no such folder");
  setContent(folder.file("a.png"), "");
  EXPECT_EQ(refusal(folder.file("a.png")),
            folder.file("a.png") + ": is no folder, but must be one of pictures");
  setContent(folder.file("texts/a.txt"), "");
  EXPECT_EQ(refusal(folder.file("texts")),
            folder.file("texts") + ": holds no pictures (.png .jpg .jpeg .bmp .tif .tiff .webp .ppm .pgm)");
}

TEST(PlaceFiles, HoldAllThatWasFound) {
  const TemporaryFolder folder;
  PlaceScores scores;
  scores.queries = 4;
  scores.recall_1 = 0.25;
  scores.recall_5 = 0.5;
  scores.recall_10 = 0.75;
  scores.pr_auc = 0.125;
  scores.recall_at_100_precision = 0.0625;
  scores.without_truth = 3;
  writePlaces(folder.file("places.csv"), {{"vlad:sift", scores}});
  EXPECT_EQ(contentOf(folder.file("places.csv")),
            "method,queries,recall_1,recall_5,recall_10,pr_auc,recall_at_100_precision,without_truth\n"
            "vlad:sift,4,0.25,0.5,0.75,0.125,0.0625,3\n");
  PlaceMatrix matrix(2, 3);
  matrix << 1.0, 2.0, 3.0, std::numeric_limits<double>::infinity(), 1.5, 1.0;
  writeMatrix(folder.file("m.csv"), matrix, {{"p.png", "q.png"}, {"a,1.png", "b.png", "c.png"}});
  EXPECT_EQ(contentOf(folder.file("m.csv")), "query,\"a,1.png\",b.png,c.png\np.png,1,2,3\nq.png,inf,1.5,1\n");
  drawMatrix(folder.file("m.png"), matrix);
  const cv::Mat drawn = cv::imread(folder.file("m.png"), cv::IMREAD_UNCHANGED);
  const cv::Mat expected = (cv::Mat_<std::uint8_t>(2, 3) << 0, 128, 255, 255, 64, 0);
  ASSERT_EQ(drawn.type(), CV_8UC1);
  ASSERT_EQ(drawn.size(), expected.size());
  EXPECT_EQ(cv::norm(drawn, expected, cv::NORM_INF), 0.0);
  drawMatrix(folder.file("m.png"), PlaceMatrix::Constant(1, 2, 4.0));
  EXPECT_EQ(cv::countNonZero(cv::imread(folder.file("m.png"), cv::IMREAD_UNCHANGED)), 0);
}

}  // namespace
}  // namespace sunlit::evaluate
