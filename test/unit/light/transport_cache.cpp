// A bake comes back from disk as it went there, and nothing else does.
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <thread>

#include "light/transport/cache_file.h"
#include "paper_scene.h"
#include "sunlit/light/transport.h"

namespace sunlit::light {
namespace {

namespace fs = std::filesystem;

scene::Scene wallOnGround(float albedo = 0.4f) {
  scene::Scene scene;
  scene.materials = {paint(albedo)};
  addGround(&scene, 0, 8.0f);
  addPatch(&scene, 0, {0.0f, -1.0f, 0.0f}, {0.0f, 2.0f, 0.0f}, {0.0f, 0.0f, 1.5f});
  return scene;
}

class TransportCache : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "sunlit_cache_XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { fs::remove_all(folder_); }

  /// Green light of all nodes under an even sky.
  std::vector<float> light(const World& world, const TransportOptions& options = {}) {
    baked_ = false;
    log_.clear();
    const auto transport = Transport::cached(
        world.geometry, options, folder_.string(), [this](double, double) { baked_ = true; },
        [this](const std::string& line) { log_.push_back(line); });
    std::vector<float> values;
    for (const Eigen::Array3f& value : transport->irradiance(uniformDay(100.0f))) values.push_back(value[1]);
    return values;
  }

  std::vector<fs::path> files() const {
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(folder_)) {
      if (entry.path().extension() != ".lock") found.push_back(entry.path());
    }
    return found;
  }
  std::string content(const fs::path& file) const {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  void write(const fs::path& file, const std::string& bytes) const {
    std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
  }
  /// The file on disk was refused for `reason`, made anew, and is good now.
  void expectRebuilt(const World& world, const std::string& reason, const std::vector<float>& expected) {
    EXPECT_EQ(light(world), expected);
    EXPECT_TRUE(baked_);
    ASSERT_EQ(log_.size(), 1u);
    EXPECT_NE(log_[0].find(reason), std::string::npos) << log_[0];
    EXPECT_NE(log_[0].find(folder_.string()), std::string::npos) << log_[0];
    EXPECT_EQ(light(world), expected);
    EXPECT_FALSE(baked_);
  }

  fs::path folder_;
  bool baked_ = false;
  std::vector<std::string> log_;
};

TEST_F(TransportCache, GivesTheSameLightWithoutBakingAgain) {
  const World world = worldOf(wallOnGround());
  const std::vector<float> first = light(world);
  EXPECT_TRUE(baked_);
  EXPECT_EQ(light(world), first);
  EXPECT_FALSE(baked_);
  EXPECT_TRUE(log_.empty());
  EXPECT_EQ(files().size(), 1u);
}

TEST_F(TransportCache, TellsScenesAndOptionsApart) {
  const std::vector<float> grey = light(worldOf(wallOnGround()));
  EXPECT_NE(light(worldOf(wallOnGround(0.8f))), grey);
  EXPECT_TRUE(baked_);
  TransportOptions options;
  options.bounces = 0;
  EXPECT_NE(light(worldOf(wallOnGround()), options), grey);
  EXPECT_TRUE(baked_);
  EXPECT_EQ(files().size(), 3u);
}

TEST_F(TransportCache, IsNotDisturbedByMaterialsThatOnlyMovingThingsUse) {
  const std::vector<float> alone = light(worldOf(wallOnGround()));
  scene::Scene more = wallOnGround();
  more.materials.push_back(paint(0.9f));
  EXPECT_EQ(light(worldOf(more)), alone);
  EXPECT_FALSE(baked_);
}

TEST_F(TransportCache, RebuildsWhatIsDamagedCutShortOrForeign) {
  const World world = worldOf(wallOnGround());
  const std::vector<float> expected = light(world);
  const fs::path file = files().at(0);
  const std::string good = content(file);

  std::string damaged = good;
  damaged[good.size() / 2] = static_cast<char>(damaged[good.size() / 2] ^ 1);
  write(file, damaged);
  expectRebuilt(world, "is damaged", expected);

  for (const std::size_t size : {good.size() - 1, good.size() / 2, std::size_t{130}}) {
    write(file, good.substr(0, size));
    expectRebuilt(world, "is cut short", expected);
  }
  for (const std::string& foreign : {std::string(), std::string("P6 640 480 255 "), std::string(500, 'x')}) {
    write(file, foreign);
    expectRebuilt(world, "is no baked light", expected);
  }
  write(file, good + "more");
  expectRebuilt(world, "is longer than it should be", expected);

  std::string counts = good;  // an absurd length must not be believed
  for (std::size_t i = 32; i < 40; ++i) counts[i] = '\x7f';
  write(file, counts);
  expectRebuilt(world, "is damaged", expected);
}

TEST_F(TransportCache, RefusesTheBakeOfAnotherSceneUnderThisName) {
  const World world = worldOf(wallOnGround()), other = worldOf(wallOnGround(0.8f));
  const std::vector<float> expected = light(world);
  const fs::path file = files().at(0);
  fs::create_directory(folder_ / "other");
  Transport::cached(other.geometry, {}, (folder_ / "other").string());
  for (const auto& entry : fs::directory_iterator(folder_ / "other")) {
    if (entry.path().extension() != ".lock")
      fs::copy_file(entry.path(), file, fs::copy_options::overwrite_existing);
  }
  fs::remove_all(folder_ / "other");
  expectRebuilt(world, "is of another scene", expected);
}

TEST_F(TransportCache, WorksWithoutAFolder) {
  const World world = worldOf(wallOnGround());
  const std::vector<float> expected = light(world);
  const fs::path file = folder_ / "a_file";
  write(file, "in the way");
  std::vector<std::string> log;
  const auto transport = Transport::cached(world.geometry, {}, (file / "below").string(), nullptr,
                                           [&](const std::string& line) { log.push_back(line); });
  EXPECT_EQ(transport->irradiance(uniformDay(100.0f)).size(), expected.size());
  ASSERT_EQ(log.size(), 1u);
  EXPECT_NE(log[0].find("a_file"), std::string::npos) << log[0];
}

TEST_F(TransportCache, IsBakedOnceByThoseWhoWantItTogether) {
  const World world = worldOf(wallOnGround());
  std::atomic<int> bakes{0};
  const auto want = [&] {
    bool baked = false;
    Transport::cached(world.geometry, {}, folder_.string(), [&](double, double) { baked = true; });
    if (baked) ++bakes;
  };
  std::thread first(want), second(want), third(want);
  first.join();
  second.join();
  third.join();
  EXPECT_EQ(bakes, 1);
  EXPECT_EQ(files().size(), 1u);
}

TEST(TransportFolder, FollowsTheEnvironment) {
  setenv("SUNLIT_CACHE_DIR", "/a", 1);
  setenv("XDG_CACHE_HOME", "/b", 1);
  setenv("HOME", "/c", 1);
  EXPECT_EQ(Transport::usualFolder(), "/a");
  unsetenv("SUNLIT_CACHE_DIR");
  EXPECT_EQ(Transport::usualFolder(), "/b/sunlit");
  unsetenv("XDG_CACHE_HOME");
  EXPECT_EQ(Transport::usualFolder(), "/c/.cache/sunlit");
}

}  // namespace
}  // namespace sunlit::light
