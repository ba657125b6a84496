#include "tools/blind_poses.h"

#include <cstdio>

#include "tools/progress_line.h"

namespace sunlit::tools {

bool warnIfBlind(const studio::Studio& studio, const std::string& where) {
  const std::optional<studio::ViewFault> fault = studio.viewFault();
  if (!fault) return false;
  ProgressLine::leave();
  std::fprintf(stderr, "warning: %s%s\n", where.c_str(), fault->reason.c_str());
  return true;
}

void BlindPoses::check(const studio::Studio& studio, std::int64_t pose) {
  const std::optional<studio::ViewFault> fault = studio.viewFault();
  if (!fault) return;
  std::set<std::int64_t>& alike = poses_[fault->poses];
  if (alike.empty()) warnIfBlind(studio, "from pose " + std::to_string(pose) + " ");
  alike.insert(pose);
}

void BlindPoses::tell() const {
  ProgressLine::leave();
  for (const auto& [what, alike] : poses_)
    std::fprintf(stderr, "warning: %zu poses %s, from number %lld to %lld\n", alike.size(), what.c_str(),
                 static_cast<long long>(*alike.begin()), static_cast<long long>(*alike.rbegin()));
}

}  // namespace sunlit::tools
