/// Where tables are kept that take seconds to make.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace sunlit::sky {

/// Both may be unset. A name says all that its numbers depend on.
struct TableStore {
  /// Empty: there are none of this name.
  std::function<std::vector<float>(const std::string& name)> find;
  std::function<void(const std::string& name, const std::vector<float>& numbers)> keep;
};

}  // namespace sunlit::sky
