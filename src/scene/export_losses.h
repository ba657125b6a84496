/// What a format has no word for, summed by kind.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace sunlit::scene {

class ExportLosses {
 public:
  /// `what` is in the plural and says what was made of it.
  void add(const std::string& what, const std::string& where);
  /// A line a kind, in the order of their first: "3 <what>: <the first of where>".
  std::vector<std::string> lines() const;

 private:
  struct Kind {
    std::string what;
    std::vector<std::string> examples;
    std::size_t count = 0;
  };
  std::vector<Kind> kinds_;
};

}  // namespace sunlit::scene
