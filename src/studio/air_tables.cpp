#include "studio/air_tables.h"

#include <cstring>
#include <exception>
#include <memory>
#include <string>
#include <vector>

#include "studio/sealed_files.h"
#include "studio/tell.h"
#include "sunlit/image/cache_folder.h"

namespace sunlit::studio {
namespace {

std::vector<float> numbersOf(const SealedFiles::Content& content) {
  if (content.size() % sizeof(float) != 0) return {};
  std::vector<float> numbers(content.size() / sizeof(float));
  std::memcpy(numbers.data(), content.data(), content.size());
  return numbers;
}

}  // namespace

sky::TableStore airTablesIn(const std::filesystem::path& folder, const Reports& reports) {
  constexpr std::uintmax_t kLimit_bytes = 100'000'000;
  const auto files = std::make_shared<const SealedFiles>(folder, ".air", kLimit_bytes);
  const auto warn = [reports](const std::string& line) { tell(reports.warning, line); };
  sky::TableStore store;
  store.find = [files](const std::string& name) {
    const auto content = files->find(name);
    return content ? numbersOf(*content) : std::vector<float>();
  };
  store.keep = [files, warn](const std::string& name, const std::vector<float>& numbers) {
    try {
      const image::CacheTurn turn = files->turn(name);
      files->keep(
          name, [&](const SealedFiles::Sink& sink) { sink(numbers.data(), numbers.size() * sizeof(float)); });
      files->tidy(warn);
    } catch (const std::exception& problem) {
      warn(image::notKeptText("tables of the air are", problem));
    }
  };
  return store;
}

}  // namespace sunlit::studio
