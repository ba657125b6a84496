#include "tools/blind_poses.h"

#include <cstdio>

#include "tools/progress_line.h"

namespace sunlit::tools {

bool warnIfBlind(const studio::Studio& studio, const std::string& where) {
  if (studio.seesAnything()) return false;
  ProgressLine::leave();
  std::fprintf(stderr, "warning: %s%s\n", where.c_str(), studio.whySeesNothing().c_str());
  return true;
}

void BlindPoses::check(const studio::Studio& studio, std::int64_t pose) {
  if (studio.seesAnything()) return;
  if (poses_.empty()) warnIfBlind(studio, "from pose " + std::to_string(pose) + " ");
  poses_.insert(pose);
}

void BlindPoses::tell() const {
  if (poses_.empty()) return;
  ProgressLine::leave();
  std::fprintf(stderr, "warning: %zu poses see nothing of the world, from number %lld to %lld\n",
               poses_.size(), static_cast<long long>(*poses_.begin()),
               static_cast<long long>(*poses_.rbegin()));
}

}  // namespace sunlit::tools
