// A bake comes back from disk as it went there, and nothing else does.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <future>
#include <mutex>
#include <optional>
#include <set>
#include <thread>
#include <utility>
#include <vector>

#include "light/bake/cache/cache_file.h"
#include "paper_scene.h"
#include "sunlit/image/cache_folder.h"
#include "sunlit/light/transport.h"
#include "support/temporary_folder.h"

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
  /// Green light of all nodes under an even sky.
  std::vector<float> light(const World& world, const TransportOptions& options = {}) {
    baked_ = false;
    log_.clear();
    const auto transport = Transport::cached(world.geometry, options, folder_.string(),
                                             {[this](double, double) { baked_ = true; },
                                              [this](const std::string& line) { log_.push_back(line); }});
    std::vector<float> values;
    for (const NodeLight& node : transport->relight(uniformDay(100.0f))) values.push_back(node.irradiance[1]);
    return values;
  }

  std::vector<fs::path> files() const {
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(folder_)) found.push_back(entry.path());
    std::sort(found.begin(), found.end());
    return found;
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

  const TemporaryFolder temporary_;
  const fs::path folder_ = temporary_.path();
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
  const std::string good = contentOf(file);

  std::string damaged = good;
  damaged[good.size() / 2] = static_cast<char>(damaged[good.size() / 2] ^ 1);
  setContent(file, damaged);
  expectRebuilt(world, "is damaged", expected);

  for (const std::size_t size : {good.size() - 1, good.size() / 2, std::size_t{330}}) {
    setContent(file, good.substr(0, size));
    expectRebuilt(world, "is cut short", expected);
  }
  for (const std::string& foreign : {std::string(), std::string("P6 640 480 255 "), std::string(500, 'x')}) {
    setContent(file, foreign);
    expectRebuilt(world, "is no baked light", expected);
  }
  setContent(file, good + "more");
  expectRebuilt(world, "is longer than it should be", expected);

  std::string counts = good;  // an absurd length must not be believed
  for (std::size_t i = 32; i < 40; ++i) counts[i] = '\x7f';
  setContent(file, counts);
  expectRebuilt(world, "is damaged", expected);
}

TEST_F(TransportCache, RefusesTheBakeOfAnotherSceneUnderThisName) {
  const World world = worldOf(wallOnGround()), other = worldOf(wallOnGround(0.8f));
  const std::vector<float> expected = light(world);
  const fs::path file = files().at(0);
  fs::create_directory(folder_ / "other");
  Transport::cached(other.geometry, {}, (folder_ / "other").string());
  for (const auto& entry : fs::directory_iterator(folder_ / "other")) {
    fs::copy_file(entry.path(), file, fs::copy_options::overwrite_existing);
  }
  fs::remove_all(folder_ / "other");
  expectRebuilt(world, "is of another scene", expected);
}

TEST_F(TransportCache, WorksWithoutAFolder) {
  const World world = worldOf(wallOnGround());
  const std::vector<float> expected = light(world);
  const fs::path file = folder_ / "a_file";
  setContent(file, "in the way");
  std::vector<std::string> log;
  const auto transport = Transport::cached(world.geometry, {}, (file / "below").string(),
                                           {nullptr, [&](const std::string& line) { log.push_back(line); }});
  EXPECT_EQ(transport->relight(uniformDay(100.0f)).size(), expected.size());
  ASSERT_EQ(log.size(), 1u);
  EXPECT_EQ(log[0], "baked light is not kept: " + (file / "below").string() +
                        ": Not a directory; SUNLIT_CACHE_DIR (of tools, --cache DIR) names another folder");
}

TEST_F(TransportCache, LeavesNothingHalfWrittenWhereTheDiskIsFull) {
  const World world = worldOf(wallOnGround());
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  rlimit little = before;
  little.rlim_cur = 1000;
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);  // so that writing fails as on a full disk
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &little), 0);
  const std::vector<float> values = light(world);
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  ASSERT_EQ(log_.size(), 1u);
  EXPECT_NE(log_[0].find(": write: File too large"), std::string::npos) << log_[0];
  EXPECT_TRUE(files().empty());
  EXPECT_EQ(light(world), values);
  EXPECT_TRUE(baked_);
}

TEST_F(TransportCache, IsBakedOnceByThoseWhoWantItTogether) {
  const World world = worldOf(wallOnGround());
  std::mutex mutex;
  std::set<ino_t> kept;  // whoever bakes leaves another file there
  const auto want = [&] {
    Transport::cached(world.geometry, {}, folder_.string());
    const std::lock_guard<std::mutex> lock(mutex);
    struct stat file;
    if (stat(files().at(0).c_str(), &file) == 0) kept.insert(file.st_ino);
  };
  std::thread first(want), second(want), third(want);
  first.join();
  second.join();
  third.join();
  EXPECT_EQ(kept.size(), 1u);
  EXPECT_EQ(files().size(), 1u);
}

TEST_F(TransportCache, SaysThatItWaitsForAnotherProcess) {
  const World world = worldOf(wallOnGround());
  light(world);
  const fs::path file = files().at(0);
  fs::remove(file);
  std::promise<std::string> note;
  std::optional<image::CacheTurn> other = image::CacheTurn::await(file);
  std::thread one([&] {
    Transport::cached(world.geometry, {}, folder_.string(),
                      {nullptr, nullptr, [&](const std::string& line) { note.set_value(line); }});
  });
  std::future<std::string> noted = note.get_future();
  const bool was_noted = noted.wait_for(std::chrono::seconds(60)) == std::future_status::ready;
  other.reset();
  one.join();
  ASSERT_TRUE(was_noted);
  const std::string line = noted.get();
  EXPECT_NE(line.find("waiting for " + file.string()), std::string::npos) << line;
  EXPECT_EQ(files().size(), 1u);
}

TEST_F(TransportCache, TellsHowFarAnotherProcessIs) {
  struct Enough : std::exception {};
  const World world = worldOf(wallOnGround());
  light(world);
  const fs::path file = files().at(0);
  fs::remove(file);
  const image::CacheTurn other = image::CacheTurn::await(file);
  std::vector<std::pair<double, double>> told;
  BakeListener listener;
  listener.progress = [&](double share, double seconds_left) { told.emplace_back(share, seconds_left); };
  int checked = 0;
  listener.check = [&] {
    if (++checked == 2) other.tell({0.25, std::nan("")});
    if (checked == 4) other.tell({0.5, 12.5});
    if (told.size() > 3) throw Enough();
  };
  EXPECT_THROW(Transport::cached(world.geometry, {}, folder_.string(), listener), Enough);
  EXPECT_EQ(told.front().first, 0.25);
  EXPECT_TRUE(std::isnan(told.front().second));
  EXPECT_EQ(told.back(), std::make_pair(0.5, 12.5));
}

TEST_F(TransportCache, TellsOfEachStageOfABake) {
  std::vector<double> told;
  BakeListener listener;
  listener.progress = [&](double share, double) { told.push_back(share); };
  scene::Scene scene = wallOnGround();
  scene::Lamp lamp;
  lamp.position = {1.0f, 0.0f, 1.0f};
  lamp.intensity = LinearRgb(100.0f, 100.0f, 100.0f);
  scene.lamps = {lamp};
  Transport::cached(worldOf(scene).geometry, {}, folder_.string(), listener);
  EXPECT_EQ(told.front(), 0.0);
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_LE(told.back(), 1.0 + 1e-9);
  const auto between = [&](double low, double high) {
    return std::any_of(told.begin(), told.end(), [&](double share) { return share > low && share < high; });
  };
  // There are no leaves, and nothing shines by itself; in so small a world some stages tell but their end.
  EXPECT_TRUE(between(0.01, 0.041)) << "kinds of triangles";
  EXPECT_TRUE(between(0.24, 0.29)) << "walls";
  EXPECT_TRUE(between(0.32, 0.401)) << "what walls have changed";
  EXPECT_TRUE(between(0.65, 0.69)) << "straight light";
  EXPECT_TRUE(between(0.87, 0.9)) << "bounces";
  EXPECT_TRUE(between(0.96, 0.999)) << "lamps";
}

TEST_F(TransportCache, EndsByWhatAListenerThrows) {
  struct Enough : std::exception {};
  const World world = worldOf(wallOnGround());
  BakeListener listener;
  listener.progress = [](double share, double) {
    if (share > 0.5) throw Enough();
  };
  EXPECT_THROW(Transport::cached(world.geometry, {}, folder_.string(), listener), Enough);
  EXPECT_TRUE(files().empty());  // nor does a lock remain

  light(world);
  const fs::path file = files().at(0);
  fs::remove(file);
  const image::CacheTurn other = image::CacheTurn::await(file);
  int noted = 0, checked = 0;
  listener = {nullptr, nullptr, [&](const std::string&) { ++noted; }};
  listener.check = [&] {
    if (++checked == 3) throw Enough();
  };
  EXPECT_THROW(Transport::cached(world.geometry, {}, folder_.string(), listener), Enough);
  EXPECT_EQ(noted, 1);
  EXPECT_FALSE(fs::exists(file));
}

// Bakes of rooms whose walls differ in colour, all of one size.
class CacheLimit : public TransportCache {
 protected:
  /// The bake of the room with walls of `albedo`, which is in use as long as the result lives.
  std::shared_ptr<const Transport> use(float albedo, std::uintmax_t limit_bytes) {
    return Transport::cached(worldOf(wallOnGround(albedo)).geometry, {}, {folder_.string(), limit_bytes});
  }
  /// The file that use() leaves behind, last used so many hours ago.
  fs::path keep(float albedo, int hours_ago) {
    const std::vector<fs::path> before = files();
    use(albedo, kMuch);
    for (const fs::path& file : files()) {
      if (std::count(before.begin(), before.end(), file) > 0) continue;
      fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(hours_ago));
      return file;
    }
    ADD_FAILURE() << "no bake was kept";
    return {};
  }
  static constexpr std::uintmax_t kMuch = 1'000'000'000;
};

TEST_F(CacheLimit, RemovesWhatHasNotBeenUsedForLongest) {
  const fs::path a = keep(0.1f, 3), b = keep(0.2f, 2), c = keep(0.3f, 1);
  const std::uintmax_t each = fs::file_size(a);
  use(0.1f, kMuch);  // the oldest, but used again
  use(0.4f, 3 * each);
  EXPECT_EQ(files().size(), 3u);
  EXPECT_TRUE(fs::exists(a));
  EXPECT_FALSE(fs::exists(b));
  EXPECT_TRUE(fs::exists(c));
  use(0.1f, each);  // also where nothing new comes in
  EXPECT_EQ(files(), std::vector<fs::path>{a});
}

TEST_F(CacheLimit, NeverRemovesWhatIsInUse) {
  const fs::path a = keep(0.1f, 3);
  auto user = use(0.1f, kMuch), other_user = use(0.1f, kMuch);
  fs::last_write_time(a, fs::file_time_type::clock::now() - std::chrono::hours(3));
  { const auto newest = use(0.2f, 0); }  // in use itself while the folder is tidied
  EXPECT_EQ(files().size(), 2u);
  user.reset();
  use(0.2f, 0);
  EXPECT_TRUE(fs::exists(a));
  other_user.reset();
  use(0.2f, 0);
  EXPECT_FALSE(fs::exists(a));
  EXPECT_EQ(files().size(), 1u);
}

TEST_F(CacheLimit, RemovesWhatTheDeadLeftAndNothingOfStrangers) {
  const std::string key(32, 'a');
  for (const std::string& left : {key + ".light.4711.part", key + ".light.lock"})
    setContent(folder_ / left, "left");
  std::vector<fs::path> strangers;
  for (const std::string& name : {std::string("film.part"), std::string("notes.light"), key + ".light.part",
                                  key + ".lighter", "x" + key + ".light", std::string("apt.lock")}) {
    strangers.push_back(folder_ / name);
    setContent(strangers.back(), "mine");
  }
  fs::create_directory(folder_ / (std::string(32, 'b') + ".light"));
  strangers.push_back(folder_ / (std::string(32, 'b') + ".light"));
  const fs::path bake = keep(0.1f, 0);
  std::vector<fs::path> expected = strangers;
  expected.push_back(bake);
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(files(), expected);
}

TEST_F(CacheLimit, LeavesABakeThatIsBeingMadeAlone) {
  const std::string bake = (folder_ / (std::string(32, 'c') + ".light")).string();
  const image::CacheTurn turn = image::CacheTurn::await(bake);
  setContent(bake + ".4711.part", "half");
  use(0.1f, 0);
  EXPECT_TRUE(fs::exists(bake + ".4711.part"));
  EXPECT_TRUE(fs::exists(bake + ".lock"));
}

}  // namespace
}  // namespace sunlit::light
