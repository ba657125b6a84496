#include "studio/kept_track.h"

#include <dlfcn.h>

#include <exception>
#include <memory>
#include <optional>
#include <string>

#include "studio/sealed_files.h"
#include "studio/tell.h"
#include "sunlit/image/cache_folder.h"
#include "sunlit/image/content_hash.h"
#include "sunlit/render/texture_sizes.h"
#include "sunlit/scene/race_track.h"
#include "sunlit/scene/scene_bytes.h"

namespace sunlit::studio {
namespace {

/// Of the libraries that make the world and its textures' smaller sizes: another build may make others. Empty
/// where one cannot be found.
std::string maker() {
  image::ContentHash hash;
  for (const void* const one : {reinterpret_cast<const void*>(&scene::raceTrack),
                                reinterpret_cast<const void*>(&render::addSmallerSizes)}) {
    Dl_info library{};
    if (dladdr(one, &library) == 0 || library.dli_fname == nullptr || !hash.addFile(library.dli_fname))
      return {};
  }
  return hash.text();
}

std::optional<scene::FlatScene> found(const SealedFiles& files, const std::string& name) {
  const std::shared_ptr<const SealedFiles::Content> content = files.find(name);
  if (!content) return std::nullopt;
  return scene::flatSceneOf(content->data(), content->size(),
                            std::shared_ptr<const image::FileBytes>(content, &content->file()));
}

}  // namespace

scene::FlatScene keptRaceTrack(const std::filesystem::path& folder, const Reports& reports,
                               const std::function<scene::Scene()>& make) {
  constexpr std::uintmax_t kLimit_bytes = 600'000'000;  // that of two builds
  const std::string name = maker();
  if (name.empty()) return scene::flattened(make());
  std::optional<scene::FlatScene> scene;
  try {
    const SealedFiles files(folder, ".scene", kLimit_bytes);
    if ((scene = found(files, name))) return *std::move(scene);
    const image::CacheTurn turn = files.turn(name);
    if ((scene = found(files, name))) return *std::move(scene);
    scene = scene::flattened(make());
    render::addSmallerSizes(&scene->scene);
    files.keep(name, [&](const SealedFiles::Sink& sink) { scene::writeBytes(*scene, sink); });
    files.tidy([&](const std::string& line) { tell(reports.warning, line); });
    // That of the file, which other processes share.
    if (std::optional<scene::FlatScene> kept = found(files, name)) return *std::move(kept);
  } catch (const std::exception& problem) {
    tell(reports.warning, image::notKeptText("the built-in world is", problem));
  }
  return scene ? *std::move(scene) : scene::flattened(make());
}

}  // namespace sunlit::studio
