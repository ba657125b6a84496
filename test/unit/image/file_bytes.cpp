#include "sunlit/image/file_bytes.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "sunlit/image/files.h"
#include "support/message_of.h"
#include "support/temporary_folder.h"

namespace sunlit {
namespace {

std::string textOf(const image::FileBytes& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

TEST(FileBytes, AreThoseOfTheFile) {
  const TemporaryFolder folder;
  const std::string path = folder.file("some"), text(100'000, 'x');
  image::writeFileAtomically(path, text + "end");
  const image::FileBytes bytes(path);
  EXPECT_EQ(textOf(bytes), text + "end");
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(bytes.data()) % 4096, 0u);
}

TEST(FileBytes, StayWhereTheFileIsReplacedOrRemoved) {
  const TemporaryFolder folder;
  const std::string path = folder.file("some");
  image::writeFileAtomically(path, "old");
  const image::FileBytes bytes(path);
  image::writeFileAtomically(path, "new and longer");
  EXPECT_EQ(textOf(bytes), "old");
  std::filesystem::remove(path);
  EXPECT_EQ(textOf(bytes), "old");
}

/// How much of `file`, mapped at `address`, is in this process' memory, kB; −1: it is not mapped there.
long resident_kB(const void* address, const std::string& file) {
  std::ostringstream wanted;
  wanted << std::hex << reinterpret_cast<std::uintptr_t>(address) << '-';
  std::ifstream maps("/proc/self/smaps");
  bool here = false;
  for (std::string line; std::getline(maps, line);) {
    if (line.rfind(wanted.str(), 0) == 0) here = line.find(file) != std::string::npos;
    if (here && line.rfind("Rss:", 0) == 0) return std::stol(line.substr(4));
  }
  return -1;
}

TEST(FileBytes, LeaveTheMemoryWhenTheyAreLetGoAndComeBack) {
  const TemporaryFolder folder;
  const std::string path = folder.file("some");
  std::string text(1'000'000, 'x');
  for (std::size_t i = 0; i < text.size(); ++i) text[i] = static_cast<char>(i * i >> 8);
  image::writeFileAtomically(path, text);
  const image::FileBytes bytes(path);
  EXPECT_EQ(textOf(bytes), text);
  if (resident_kB(bytes.data(), path) < 0) GTEST_SKIP() << "files in " << path << " are read, not mapped";
  bytes.letGo(bytes.data() + 1, 3 * 4096);  // two pages whole
  EXPECT_EQ(textOf(bytes), text);
  bytes.letGo(bytes.data(), bytes.size());
  EXPECT_LE(resident_kB(bytes.data(), path), 64);  // its last page is not filled
  EXPECT_EQ(textOf(bytes), text);
}

TEST(FileBytes, OfAnEmptyFileAreNone) {
  const TemporaryFolder folder;
  const std::string path = folder.file("some");
  image::writeFileAtomically(path, "");
  EXPECT_EQ(image::FileBytes(path).size(), 0u);
}

TEST(FileBytes, OfWhatIsNoFileAreRefused) {
  const TemporaryFolder folder;
  const std::string path = folder.path();
  EXPECT_EQ(messageOf<std::runtime_error>([&] { image::FileBytes{path}; }), path + ": read: Is a directory");
  EXPECT_EQ(messageOf<std::runtime_error>([&] { image::FileBytes{path + "/none"}; }),
            path + "/none: open: No such file or directory");
}

}  // namespace
}  // namespace sunlit
