#include "sunlit/image/file_bytes.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
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
