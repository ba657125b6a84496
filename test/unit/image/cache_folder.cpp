#include "sunlit/image/cache_folder.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>

#include "support/temporary_folder.h"

namespace sunlit::image {
namespace {

namespace fs = std::filesystem;

TEST(UsualCacheFolder, FollowsTheEnvironment) {
  setenv("SUNLIT_CACHE_DIR", "/a", 1);
  setenv("XDG_CACHE_HOME", "/b", 1);
  setenv("HOME", "/c", 1);
  EXPECT_EQ(usualCacheFolder(), "/a");
  unsetenv("SUNLIT_CACHE_DIR");
  EXPECT_EQ(usualCacheFolder(), "/b/sunlit");
  unsetenv("XDG_CACHE_HOME");
  EXPECT_EQ(usualCacheFolder(), "/c/.cache/sunlit");
}

// Bakes are tested to be tidied by age and use, in test/unit/light/transport_cache.cpp.
TEST(CacheFolder, LeavesFilesOfOtherEndingsAndThoseUsedSince) {
  const TemporaryFolder temporary;
  const fs::path folder = temporary.path();
  const fs::file_time_type now = fs::file_time_type::clock::now();
  const auto add = [&](const std::string& name, int hours_ago) {
    setContent(folder / name, "ten bytes!");
    fs::last_write_time(folder / name, now - std::chrono::hours(hours_ago));
    return folder / name;
  };
  const fs::path old = add(std::string(32, 'a') + ".features", 9);
  const fs::path used = add(std::string(32, 'b') + ".features", 1);
  const fs::path other = add(std::string(32, 'c') + ".light", 9);
  const CacheFolder cache{folder, ".features"};
  EXPECT_EQ(cache.usedBytes(), 20u);
  EXPECT_EQ(cache.tidy(20, nullptr), 20u);
  EXPECT_EQ(cache.tidy(0, nullptr, now - std::chrono::hours(2)), 10u);
  EXPECT_FALSE(fs::exists(old));
  EXPECT_TRUE(fs::exists(used));
  EXPECT_EQ(cache.tidy(9, nullptr), 0u);
  EXPECT_FALSE(fs::exists(used));
  EXPECT_TRUE(fs::exists(other));
  EXPECT_EQ((CacheFolder{folder / "none", ".features"}.usedBytes()), 0u);
}

}  // namespace
}  // namespace sunlit::image
