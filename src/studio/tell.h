/// Lines for a person who may not listen.
#pragma once

#include <functional>
#include <string>

namespace sunlit::studio {

inline void tell(const std::function<void(const std::string&)>& listener, const std::string& line) {
  if (listener) listener(line);
}

}  // namespace sunlit::studio
