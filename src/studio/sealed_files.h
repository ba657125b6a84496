/// What takes long to make, kept as bytes from one process to the next.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "sunlit/image/cache_folder.h"
#include "sunlit/image/file_bytes.h"

namespace sunlit::studio {

/// Files of one kind in a cache folder, each behind a seal that tells whether it is whole and of its name.
class SealedFiles {
 public:
  using Sink = std::function<void(const void* data, std::size_t size)>;

  /// As image::CacheFolder has them. Removes what was left by processes that were killed.
  SealedFiles(std::filesystem::path folder, std::string ending, std::uintmax_t limit_bytes);

  /// The content of one file, which is kept as long as this lives.
  class Content {
   public:
    explicit Content(const std::filesystem::path& file) : in_use_(file), bytes_(file.string()) {}
    const std::byte* data() const;
    const image::FileBytes& file() const { return bytes_; }
    std::size_t size() const;

   private:
    friend class SealedFiles;
    bool isOf(const std::string& name) const;
    image::CacheUse in_use_;
    image::FileBytes bytes_;
  };
  /// Null: there is none, or it is damaged. `name` is anything that tells contents apart.
  std::unique_ptr<const Content> find(const std::string& name) const;

  /// Waits until no other process makes it.
  image::CacheTurn turn(const std::string& name) const;
  /// While the turn is held: what `write` gives its argument. Throws std::runtime_error with the path.
  void keep(const std::string& name, const std::function<void(const Sink&)>& write) const;
  /// See image::CacheFolder::tidy().
  void tidy(const image::CacheFolder::Log& log) const { folder_.tidy(limit_bytes_, log); }

 private:
  std::filesystem::path fileOf(const std::string& name) const;

  image::CacheFolder folder_;
  std::uintmax_t limit_bytes_;
};

}  // namespace sunlit::studio
