#include "light/picture/gather/kept_nodes.h"

#include <algorithm>
#include <utility>

namespace sunlit::light {
namespace {

/// An age ends before it holds the nodes of more than so many poses, as large as the largest that it and the
/// one before it know: with that one, a camera that drives on finds most of what it saw in the last ten
/// poses.
constexpr std::size_t kPosesOfAge = 3;

}  // namespace

std::vector<KeptNodes::Key> KeptNodes::require(const std::vector<Key>& keys) {
  const std::size_t pose = std::max({keys.size(), now_.largest, before_.largest});
  if (now_.skies.size() + keys.size() > kPosesOfAge * pose) {
    before_ = std::move(now_);
    now_ = Age();
  }
  now_.largest = std::max(now_.largest, keys.size());
  std::vector<Key> fresh;
  for (const Key key : keys) {
    const bool is_new = now_.number.try_emplace(key, static_cast<std::uint32_t>(now_.skies.size())).second;
    if (!is_new) continue;
    const auto kept = before_.number.find(key);
    if (kept == before_.number.end()) fresh.push_back(key);
    now_.skies.push_back(kept == before_.number.end() ? GatheredSky() : before_.skies[kept->second]);
  }
  return fresh;
}

}  // namespace sunlit::light
