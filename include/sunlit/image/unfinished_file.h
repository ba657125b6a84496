/// A file on its way: whole or not there at all.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace sunlit::image {

/// Written beside its place under another name, NAME.PROCESS.NUMBER.part, and removed again unless it is
/// kept: what was in its place stays there until then, even if the process is killed or the power fails. What
/// killed ones leave removeUnfinished() takes away; those that still write hold a lock (flock). Throws
/// std::runtime_error "path: what failed: why", of the path that was meant.
class UnfinishedFile {
 public:
  static constexpr const char* kEnding = ".part";

  /// The folder of `place` must exist. `kind`, such as ".mp4", stands behind kEnding, for others that write
  /// to the file by the end of its name.
  explicit UnfinishedFile(std::filesystem::path place, const std::string& kind = "");
  ~UnfinishedFile();
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;

  /// Where it is until it is kept.
  const std::filesystem::path& path() const { return path_; }
  void write(const void* data, std::size_t size);
  /// What write() has written so far.
  std::size_t size() const { return size_; }
  /// Makes it durable (fsync), and gives it its name. Nothing can be written any more.
  void keep();

 private:
  std::filesystem::path place_, path_;
  int descriptor_ = -1;
  std::size_t size_ = 0;
  bool kept_ = false;
};

}  // namespace sunlit::image
