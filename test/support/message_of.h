/// What a refusal says.
#pragma once

#include <stdexcept>
#include <string>

namespace sunlit {

/// The text of the `Error` that `call` throws; empty if it throws none.
template <typename Error = std::invalid_argument, typename Call>
std::string messageOf(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace sunlit
