#include "sunlit/image/exposure_lag.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace sunlit::image {
namespace {

int memoryOf(double adaptation, int delay) {
  constexpr double kForgotten_ev = 0.01, kGreatest_ev = 3.0;
  const int steps =
      adaptation >= 1.0
          ? 0
          : static_cast<int>(std::ceil(std::log(kForgotten_ev / kGreatest_ev) / std::log1p(-adaptation)));
  return delay + steps;
}

}  // namespace

ExposureLag::ExposureLag(const ExposureOptions& options)
    : adaptation_(options.mode == ExposureMode::kFixed ? 1.0 : options.adaptation),
      delay_(options.mode == ExposureMode::kFixed ? 0 : options.delay),
      memory_(memoryOf(adaptation_, delay_)) {}

std::int64_t ExposureLag::firstMissing(std::int64_t index) const {
  const std::int64_t wanted = std::max<std::int64_t>(0, index - memory_);
  const bool goes_on = !metered_.empty() && last_ < index && last_ + 1 >= wanted;
  return goes_on ? last_ + 1 : wanted;
}

void ExposureLag::add(std::int64_t index, double metered_ev100) {
  if (index != last_ + 1) metered_.clear();
  metered_.push_back(metered_ev100);
  if (metered_.size() > static_cast<std::size_t>(memory_) + 1) metered_.pop_front();
  last_ = index;
}

double ExposureLag::ev100() const {
  if (metered_.empty()) throw std::logic_error("add() must be called before ev100()");
  double ev100 = metered_.front();
  for (std::size_t i = 1; i < metered_.size(); ++i) {
    const std::size_t by = i - std::min(i, static_cast<std::size_t>(delay_));
    ev100 += adaptation_ * (metered_[by] - ev100);
  }
  return ev100;
}

}  // namespace sunlit::image
