/// Lines for a person who may not listen.
#pragma once

#include <functional>
#include <string>

#include "sunlit/studio/reports.h"

namespace sunlit::studio {

inline void tell(const std::function<void(const std::string&)>& listener, const std::string& line) {
  if (listener) listener(line);
}

inline void tellFlaw(const Reports& reports, const std::string& line) {
  tell(reports.flaw ? reports.flaw : reports.warning, line);
}

}  // namespace sunlit::studio
