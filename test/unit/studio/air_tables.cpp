#include "studio/air_tables.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "sunlit/image/files.h"
#include "support/temporary_folder.h"

namespace sunlit::studio {
namespace {

using Numbers = std::vector<float>;

/// The only file of a folder.
std::string fileIn(const std::string& folder) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path());
  return files.size() == 1 ? files[0] : std::string();
}

TEST(AirTables, AreFoundAgainByTheirNames) {
  const TemporaryFolder folder;
  const std::string cache = folder.file("made/when needed");
  const Numbers hazy = {1.0f, -0.0f, 3e-30f}, clear = {4.0f};
  const sky::TableStore store = airTablesIn(cache, {});
  EXPECT_EQ(store.find("hazy"), Numbers());
  store.keep("hazy", hazy);
  store.keep("clear", clear);
  const sky::TableStore later = airTablesIn(cache, {});
  EXPECT_EQ(later.find("hazy"), hazy);
  EXPECT_EQ(later.find("clear"), clear);
  EXPECT_EQ(later.find("other"), Numbers());
}

TEST(AirTables, ThatAreDamagedAreNone) {
  const TemporaryFolder folder;
  const sky::TableStore store = airTablesIn(folder.path(), {});
  store.keep("some", Numbers(1000, 0.5f));
  const std::string file = fileIn(folder.path()), whole = contentOf(file);
  ASSERT_FALSE(whole.empty());
  std::string flipped = whole;
  flipped[2000] = static_cast<char>(flipped[2000] ^ 1);
  for (const std::string& damaged :
       {flipped, whole.substr(0, 1000), whole.substr(0, 7), whole + "four", std::string()}) {
    image::writeFileAtomically(file, damaged);
    EXPECT_EQ(store.find("some"), Numbers());
  }
  image::writeFileAtomically(file, whole);
  EXPECT_EQ(store.find("some"), Numbers(1000, 0.5f));
  // A file that bears another one's name.
  store.keep("other", {1.0f});
  std::filesystem::remove(file);
  std::filesystem::rename(fileIn(folder.path()), file);
  EXPECT_EQ(store.find("some"), Numbers());
}

TEST(AirTables, LeaveNothingOfAProcessThatWasKilled) {
  const TemporaryFolder folder;
  airTablesIn(folder.path(), {}).keep("some", {1.0f});
  const std::string file = fileIn(folder.path());
  image::writeFileAtomically(file + ".lock", "");
  image::writeFileAtomically(file + ".999999999.0.part", "half");
  EXPECT_EQ(airTablesIn(folder.path(), {}).find("some"), Numbers{1.0f});
  EXPECT_EQ(fileIn(folder.path()), file);
}

TEST(AirTables, ThatCannotBeKeptAreWarnedOf) {
  const TemporaryFolder folder;
  image::writeFileAtomically(folder.file("file"), "");
  std::vector<std::string> warnings;
  Reports reports;
  reports.warning = [&](const std::string& line) { warnings.push_back(line); };
  const sky::TableStore store = airTablesIn(folder.file("file") + "/below", reports);
  store.keep("some", {1.0f});
  EXPECT_EQ(store.find("some"), Numbers());
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0],
            "tables of the air are not kept: " + folder.file("file") +
                "/below: Not a directory; SUNLIT_CACHE_DIR (of tools, --cache DIR) names another "
                "folder");
}

}  // namespace
}  // namespace sunlit::studio
