/// What somebody was told, or what was wrong with it.
#pragma once

#include <string>
#include <utility>

namespace sunlit::evaluate {

/// Something that may not have come, and of what came may be unusable.
template <typename Value>
struct Told {
  Value value = {};
  std::string fault;  ///< why it cannot be used; empty where it can
  bool has_come = false;
};

template <typename Value>
Told<Value> told(Value value) {
  return {std::move(value), "", true};
}

template <typename Value>
Told<Value> unusable(std::string fault) {
  return {{}, std::move(fault), true};
}

}  // namespace sunlit::evaluate
