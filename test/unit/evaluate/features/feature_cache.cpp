// Features come back from disk as they went there, and nothing else does.
#include "sunlit/evaluate/features/feature_cache.h"

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <opencv2/imgproc.hpp>

#include "evaluate/features/detector_pool.h"
#include "sunlit/image/content_hash.h"
#include "support/temporary_folder.h"

namespace sunlit::evaluate {
namespace {

namespace fs = std::filesystem;

cv::Mat greyOf(int seed) {
  cv::Mat grey(120, 160, CV_8U);
  cv::RNG(static_cast<std::uint64_t>(seed)).fill(grey, cv::RNG::UNIFORM, 0, 256);
  cv::GaussianBlur(grey, grey, {}, 1.5);
  return grey;
}

std::string bitsOf(const Features& features) {
  const std::string points(reinterpret_cast<const char*>(features.key_points.data()),
                           features.key_points.size() * sizeof(cv::KeyPoint));
  const cv::Mat& d = features.descriptors;
  return points + "|" + std::to_string(d.rows) + "x" + std::to_string(d.cols) + " " +
         cv::typeToString(d.type()) +
         std::string(reinterpret_cast<const char*>(d.data), d.total() * d.elemSize());
}

class Cache : public testing::Test {
 protected:
  std::shared_ptr<FeatureCache> open(std::uintmax_t limit_bytes = 1'000'000'000) {
    return std::make_shared<FeatureCache>(folder_.string(), limit_bytes,
                                          [this](const std::string& line) { log_.push_back(line); });
  }
  /// As a run of its own would find them, and whether it had them on disk.
  std::pair<std::string, bool> find(const Detector& detector, const cv::Mat& grey,
                                    std::uintmax_t limit_bytes = 1'000'000'000) {
    const auto cache = open(limit_bytes);
    const std::string bits = bitsOf(DetectorPool(detector, cache).detect(Picture{{}, grey}));
    return {bits, cache->found() > 0};
  }
  std::vector<fs::path> files() const {
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(folder_)) found.push_back(entry.path());
    std::sort(found.begin(), found.end());
    return found;
  }

  const TemporaryFolder temporary_;
  const fs::path folder_ = fs::path(temporary_.path()) / "features";
  std::vector<std::string> log_;
};

TEST_F(Cache, GivesTheSameBitsForEveryDetector) {
  for (const std::string& type : readyDetectorTypes()) {
    SCOPED_TRACE(type);
    const auto detector = makeDetector(type);
    for (const cv::Mat& grey : {greyOf(1), cv::Mat(cv::Mat::zeros(120, 160, CV_8U))}) {
      const std::string plain = bitsOf(detectFeatures(*detector, Picture{{}, grey}));
      EXPECT_EQ(find(*detector, grey), std::make_pair(plain, false));
      EXPECT_EQ(find(*detector, grey), std::make_pair(plain, true));
    }
  }
  EXPECT_EQ(files().size(), 2 * readyDetectorTypes().size());
  EXPECT_TRUE(log_.empty());
}

TEST_F(Cache, TellsPicturesDetectorsAndOptionsApart) {
  const auto orb = makeDetector("orb");
  find(*orb, greyOf(1));
  EXPECT_FALSE(find(*orb, greyOf(2)).second);
#ifdef SUNLIT_SIFT
  EXPECT_FALSE(find(*makeDetector("sift"), greyOf(1)).second);
  EXPECT_FALSE(find(*makeDetector("rootsift"), greyOf(1)).second) << "whose parameters are those of sift";
#endif
  const auto other = makeDetector("orb");
  fieldOf(other->fields(), "scale_factor").set(1.2 + 1e-15, "");  // another number, in 16 digits
  EXPECT_FALSE(find(*other, greyOf(1)).second);
  // Of equal pixels another shape, and a part of a larger picture.
  const cv::Mat grey = greyOf(1);
  EXPECT_NE(featureKey("a", grey), featureKey("a", grey.reshape(1, 160)));
  cv::Mat larger(140, 180, CV_8U, cv::Scalar(7));
  grey.copyTo(larger(cv::Rect(5, 9, 160, 120)));
  EXPECT_EQ(featureKey("a", grey), featureKey("a", larger(cv::Rect(5, 9, 160, 120))));
}

TEST_F(Cache, KnowsADetectorUnderAnyNameAndAPreprocessingByWhatItMakes) {
  cv::Mat rgb;
  cv::cvtColor(greyOf(1), rgb, cv::COLOR_GRAY2RGB);
  const Picture picture = makePicture(rgb);
  const auto foundBy = [&](const Detector& detector) {
    const auto cache = open();
    DetectorPool(detector, cache).detect(picture);
    return cache->found();
  };
  EXPECT_EQ(foundBy(*makeDetector("orb")), 0u);
  EXPECT_EQ(foundBy(*makeOwnDetector({"orb", ""})), 1u);
  EXPECT_EQ(foundBy(*makeDetector(DetectorKind::named("orb+gamma"))), 0u);
  const auto straight = makeDetector(DetectorKind::named("orb+gamma"));
  fieldOf(straight->fields(), "gamma/exponent").set(1.0, "");
  EXPECT_EQ(foundBy(*straight), 1u) << "v^1 is v";
}

TEST_F(Cache, FindsDamageAndMendsIt) {
  const auto orb = makeDetector("orb");
  const std::string expected = find(*orb, greyOf(1)).first;
  const fs::path file = files().at(0);
  const std::string good = contentOf(file);
  std::vector<std::string> bad = {"", good.substr(0, 20), good.substr(0, good.size() - 1), good + "x",
                                  std::string(500, 'x')};
  // The header: magic, version, points, rows, columns, type, nothing, checksum; then a point.
  for (const std::size_t at : {0, 8, 12, 16, 20, 24, 28, 32, 60}) {
    bad.push_back(good);
    bad.back()[at] = static_cast<char>(bad.back()[at] ^ 1);
  }
  bad.push_back(good);
  bad.back().back() = static_cast<char>(bad.back().back() ^ 1);
  for (const std::string& content : bad) {
    log_.clear();
    setContent(file, content);
    EXPECT_EQ(find(*orb, greyOf(1)), std::make_pair(expected, false));
    ASSERT_EQ(log_.size(), 1u);
    EXPECT_EQ(log_[0].rfind("features are found anew: " + file.string() + ": ", 0), 0u) << log_[0];
    EXPECT_EQ(contentOf(file), good);
  }
  // Good features under the name of others.
  find(*orb, greyOf(2));
  const std::vector<fs::path> both = files();
  fs::copy_file(file, both[0] == file ? both[1] : both[0], fs::copy_options::overwrite_existing);
  EXPECT_FALSE(find(*orb, greyOf(2)).second);
}

TEST_F(Cache, IsOneWarningWhereTheFolderCannotBeUsed) {
  setContent(folder_, "a file in the way");
  const auto orb = makeDetector("orb");
  const std::string expected = bitsOf(detectFeatures(*orb, Picture{{}, greyOf(1)}));
  for (const int seed : {1, 2, 1}) {
    const auto found = find(*orb, greyOf(seed));
    EXPECT_EQ(found.first == expected, seed == 1);
    EXPECT_FALSE(found.second);
  }
  ASSERT_EQ(log_.size(), 3u);  // one for each that was opened
  EXPECT_EQ(log_[0].rfind("features are not kept for other runs: " + folder_.string() + ": ", 0), 0u)
      << log_[0];
}

TEST_F(Cache, RemovesWhatHasNotBeenUsedForLongestButNothingOfItsOwn) {
  const auto orb = makeDetector("orb");
  fieldOf(orb->fields(), "n_features")
      .set(30, "");  // as many in every picture, so that files are of one size
  std::vector<fs::path> kept;
  for (int i = 0; i < 3; ++i) {
    find(*orb, greyOf(i));
    for (const fs::path& file : files()) {
      if (std::count(kept.begin(), kept.end(), file) > 0) continue;
      kept.push_back(file);
      fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(9 - i));
      break;
    }
  }
  const std::uintmax_t each = fs::file_size(kept[0]);
  EXPECT_TRUE(find(*orb, greyOf(0)).second);  // the oldest, but used again
  find(*orb, greyOf(5), 3 * each + each / 2);
  EXPECT_TRUE(fs::exists(kept[0]));
  EXPECT_FALSE(fs::exists(kept[1]));
  EXPECT_EQ(files().size(), 3u);
  // One run that finds more than there is room for keeps the first, so that it finds them the next time.
  log_.clear();
  fs::remove_all(folder_);
  const auto cache = open(3 * each + each / 2);
  DetectorPool pool(*orb, cache);
  for (int i = 0; i < 9; ++i) pool.detect(Picture{{}, greyOf(i)});
  EXPECT_EQ(files().size(), 3u);
  ASSERT_EQ(log_.size(), 1u);
  EXPECT_NE(log_[0].find("has reached the limit of "), std::string::npos) << log_[0];
  EXPECT_TRUE(find(*orb, greyOf(0), 3 * each + each / 2).second);
}

TEST_F(Cache, MayBeUsedByManyAtTheSameTime) {
  const auto orb = makeDetector("orb");
  std::vector<std::string> expected;
  for (int i = 0; i < 3; ++i) expected.push_back(bitsOf(detectFeatures(*orb, Picture{{}, greyOf(i)})));
  // Several pools and caches, as of several processes: their turns are told apart by the file.
  std::atomic<int> different{0};
  tbb::parallel_for(0, 60, [&](int task) {
    const auto cache = std::make_shared<FeatureCache>(folder_.string(), 1'000'000'000);
    DetectorPool pool(*orb, cache);
    if (bitsOf(pool.detect(Picture{{}, greyOf(task % 3)})) != expected[task % 3]) ++different;
  });
  EXPECT_EQ(different, 0);
  EXPECT_EQ(files().size(), 3u);  // nothing half-written is left
}

/// `bytes` of a file kept under `key`, with the checksum that is right for it.
std::string withChecksum(std::string bytes, const std::string& key) {
  constexpr std::size_t kChecksumAt = 32, kHeader = 48;
  image::ContentHash hash;
  hash.addBytes(key.data(), key.size());
  hash.addBytes(bytes.data(), kChecksumAt);
  hash.addBytes(bytes.data() + kHeader, bytes.size() - kHeader);
  const auto number = hash.number();
  bytes.replace(kChecksumAt, sizeof(number), reinterpret_cast<const char*>(&number), sizeof(number));
  return bytes;
}

TEST_F(Cache, TellsOfFilesThatCannotBeReadByTheirCount) {
  const std::string key = "0123456789abcdef0123456789abcdef";
  const auto cache = open();
  cache->keep(key, Features());
  const std::string file = files().at(0);
  for (int i = 0; i < 120; ++i) {
    setContent(file, "damaged");
    EXPECT_FALSE(cache->find(key));
  }
  ASSERT_EQ(log_.size(), 3u);
  EXPECT_EQ(log_[0].find("so far"), std::string::npos) << log_[0];
  EXPECT_NE(log_[1].find("; so far 10 files of them"), std::string::npos) << log_[1];
  EXPECT_NE(log_[2].find("; so far 100 files of them"), std::string::npos) << log_[2];
}

TEST_F(Cache, BelievesNoNumbersThatDoNotFitWhateverTheChecksumSays) {
  const std::string key = "0123456789abcdef0123456789abcdef";
  Features features;
  features.key_points.resize(2);
  features.descriptors = cv::Mat::ones(2, 8, CV_32F);
  {
    const auto cache = open();
    cache->keep(key, features);
    ASSERT_TRUE(cache->find(key));
  }
  const std::string file = files().at(0), good = contentOf(file);
  // Points, rows, columns and type of the header.
  for (const auto& [at, number] : {std::pair{12, 3},
                                   {12, -1},
                                   {16, -1},
                                   {16, 1},
                                   {16, 0x7FFFFFFF},
                                   {20, 9},
                                   {24, CV_64F},
                                   {24, 1 << 20}}) {
    std::string wrong = good;
    wrong.replace(static_cast<std::size_t>(at), sizeof(number), reinterpret_cast<const char*>(&number),
                  sizeof(number));
    setContent(file, withChecksum(wrong, key));
    log_.clear();
    EXPECT_FALSE(open()->find(key)) << at << " " << number;
    ASSERT_EQ(log_.size(), 1u);
    EXPECT_NE(log_[0].find("holds other numbers of features than it says"), std::string::npos) << log_[0];
  }
}

}  // namespace
}  // namespace sunlit::evaluate
