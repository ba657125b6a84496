#include "studio/kept_track.h"

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "studio/sealed_files.h"
#include "sunlit/image/content_hash.h"
#include "sunlit/image/files.h"
#include "sunlit/render/texture_sizes.h"
#include "sunlit/scene/race_track.h"
#include "sunlit/scene/scene_bytes.h"
#include "support/temporary_folder.h"

namespace sunlit::studio {
namespace {

/// Of every byte of it.
std::string hashOf(const scene::FlatScene& scene) {
  image::ContentHash hash;
  scene::writeBytes(scene, [&](const void* data, std::size_t size) { hash.addBytes(data, size); });
  return hash.text();
}

std::vector<std::string> filesIn(const std::string& folder) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path());
  return files;
}

/// As scene::raceTrack(), which takes seconds to paint.
const scene::Scene& painted() {
  static const scene::Scene track = scene::raceTrack();
  return track;
}

/// As it is kept.
scene::FlatScene whole() {
  scene::FlatScene flat = scene::flattened(painted());
  render::addSmallerSizes(&flat.scene);
  return flat;
}

TEST(KeptTrack, IsTheOneThatIsMadeAlsoFromAFileAndBesideADamagedOne) {
  const TemporaryFolder folder;
  const std::string made = hashOf(whole()), cache = folder.file("made/when needed");
  int makings = 0;
  const auto make = [&] {
    ++makings;
    return painted();
  };
  EXPECT_EQ(hashOf(keptRaceTrack(cache, {})), made);
  const std::vector<std::string> files = filesIn(cache);
  ASSERT_EQ(files.size(), 1u);
  const auto written = std::filesystem::last_write_time(files[0]);
  EXPECT_EQ(hashOf(keptRaceTrack(cache, {}, make)), made);
  EXPECT_EQ(makings, 0);
  EXPECT_EQ(filesIn(cache), files);
  std::string damaged = contentOf(files[0]);
  damaged[damaged.size() / 2] = static_cast<char>(damaged[damaged.size() / 2] ^ 1);
  image::writeFileAtomically(files[0], damaged);
  EXPECT_EQ(hashOf(keptRaceTrack(cache, {}, make)), made);
  EXPECT_EQ(makings, 1);
  EXPECT_NE(contentOf(files[0]), damaged);
  EXPECT_EQ(filesIn(cache), files);
  EXPECT_NE(std::filesystem::last_write_time(files[0]), written);
}

// Of another build of either library is another file: each makes a part of what is kept.
TEST(KeptTrack, IsCalledByTheLibrariesThatMakeItAndItsSmallerSizes) {
  constexpr std::uintmax_t kNoLimit_bytes = std::numeric_limits<std::uintmax_t>::max();
  const TemporaryFolder folder;
  keptRaceTrack(folder.path(), {}, painted);
  image::ContentHash makers;
  for (const void* const maker : {reinterpret_cast<const void*>(&scene::raceTrack),
                                  reinterpret_cast<const void*>(&render::addSmallerSizes)}) {
    Dl_info library{};
    ASSERT_NE(dladdr(maker, &library), 0);
    ASSERT_TRUE(makers.addFile(library.dli_fname));
  }
  EXPECT_NE(SealedFiles(folder.path(), ".scene", kNoLimit_bytes).find(makers.text()), nullptr);
}

TEST(KeptTrack, ThatCannotBeKeptIsWarnedOf) {
  const TemporaryFolder folder;
  image::writeFileAtomically(folder.file("file"), "");
  std::vector<std::string> warnings;
  Reports reports;
  reports.warning = [&](const std::string& line) { warnings.push_back(line); };
  EXPECT_EQ(keptRaceTrack(folder.file("file") + "/below", reports, painted).shape.triangles.size(),
            scene::Shape(painted()).triangles.size());
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find(folder.file("file")), std::string::npos) << warnings[0];
}

}  // namespace
}  // namespace sunlit::studio
