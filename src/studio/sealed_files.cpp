#include "studio/sealed_files.h"

#include <cstring>
#include <exception>
#include <system_error>
#include <utility>

#include "sunlit/image/content_hash.h"
#include "sunlit/image/unfinished_file.h"

namespace sunlit::studio {
namespace {

namespace fs = std::filesystem;

/// The last bytes of a file: of its name and of all before them.
using Seal = image::ContentHash::Number;

image::ContentHash sealBegun(const std::string& name) {
  image::ContentHash hash;
  hash.addBytes(name.data(), name.size());
  return hash;
}

}  // namespace

SealedFiles::SealedFiles(fs::path folder, std::string ending, std::uintmax_t limit_bytes)
    : folder_{std::move(folder), std::move(ending)}, limit_bytes_(limit_bytes) {
  tidy(nullptr);
}

const std::byte* SealedFiles::Content::data() const {
  return bytes_.data();
}

std::size_t SealedFiles::Content::size() const {
  return bytes_.size() - sizeof(Seal);
}

bool SealedFiles::Content::isOf(const std::string& name) const {
  if (bytes_.size() < sizeof(Seal)) return false;
  Seal seal{};
  std::memcpy(&seal, data() + size(), sizeof(seal));
  image::ContentHash hash = sealBegun(name);
  hash.addBytes(data(), size());
  bytes_.letGo(data(), size());
  return seal == hash.number();
}

std::unique_ptr<const SealedFiles::Content> SealedFiles::find(const std::string& name) const {
  const fs::path file = fileOf(name);
  std::error_code none;
  if (!fs::exists(file, none)) return nullptr;
  try {
    auto content = std::make_unique<const Content>(file);
    return content->isOf(name) ? std::move(content) : nullptr;
  } catch (const std::exception&) {
    return nullptr;  // keeping it anew will say what is amiss
  }
}

image::CacheTurn SealedFiles::turn(const std::string& name) const {
  fs::create_directories(folder_.path);
  return image::CacheTurn::await(fileOf(name));
}

void SealedFiles::keep(const std::string& name, const std::function<void(const Sink&)>& write) const {
  image::UnfinishedFile file(fileOf(name));
  image::ContentHash hash = sealBegun(name);
  write([&](const void* data, std::size_t size) {
    file.write(data, size);
    hash.addBytes(data, size);
  });
  const Seal seal = hash.number();
  file.write(&seal, sizeof(seal));
  file.keep();
}

fs::path SealedFiles::fileOf(const std::string& name) const {
  return folder_.path / (sealBegun(name).text() + folder_.ending);
}

}  // namespace sunlit::studio
