#include "tools/blind_poses.h"

#include <cstdio>

#include "tools/progress_line.h"

namespace sunlit::tools {

namespace {

void warn(const std::string& text) {
  ProgressLine::leave();
  std::fprintf(stderr, "warning: %s\n", text.c_str());
}

}  // namespace

bool warnIfBlind(const studio::Studio& studio) {
  const std::optional<studio::ViewFault> fault = studio.viewFault();
  if (fault) warn(fault->reason);
  return fault.has_value();
}

void BlindPoses::check(const studio::Studio& studio, std::int64_t pose) {
  const std::optional<studio::ViewFault> fault = studio.viewFault();
  if (!fault) return;
  std::set<std::int64_t>& alike = poses_[fault->poses];
  if (alike.empty()) warn("from pose " + std::to_string(pose) + " " + fault->reason);
  alike.insert(pose);
}

void BlindPoses::tell() const {
  for (const auto& [what, alike] : poses_)
    warn(std::to_string(alike.size()) + " poses " + what + ", from number " + std::to_string(*alike.begin()) +
         " to " + std::to_string(*alike.rbegin()));
}

}  // namespace sunlit::tools
