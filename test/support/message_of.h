/// What a refusal says.
#pragma once

#include <stdexcept>
#include <string>

namespace sunlit {

/// The text of the std::invalid_argument that `call` throws; empty if it throws none.
template <typename Call>
std::string messageOf(const Call& call) {
  try {
    call();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

}  // namespace sunlit
