/// The measures that verified.csv has columns for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "sunlit/evaluate/verify/verify.h"

namespace sunlit::evaluate {

struct Measure {
  using Place = std::variant<double*, std::size_t*, std::uint32_t*>;
  std::string name;
  std::function<Place(Verified&)> place;

  /// NaN where it is undefined.
  double of(const Verified& verified) const;
  /// Throws std::runtime_error for what is no number, or no count where it is one.
  void read(const std::string& text, Verified& verified) const;
};

/// In the order of the columns.
const std::vector<Measure>& measures();

}  // namespace sunlit::evaluate
