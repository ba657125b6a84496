/// Reading of command line options.
#pragma once

#include <cstddef>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sunlit::tools {

/// Throws std::invalid_argument naming option, value and what is allowed.
[[noreturn]] void reject(const std::string& option, const std::string& value, const std::string& allowed);

/// `text` as from `count.first` to `count.second` finite numbers separated by `separator`. All of these throw
/// as reject() does.
std::vector<double> numbers(const std::string& option, const std::string& text,
                            std::pair<std::size_t, std::size_t> count, char separator = ',');
/// `file` can be written: it ends in `ending`, such as ".png", since what is written is of that kind,
/// whatever the name; and its folder is there, which is better known before the work than after it.
void requireFile(const std::string& option, const std::string& file, const std::string& ending);
void requireFolderOf(const std::string& option, const std::string& file);
double numberWithin(const std::string& option, const std::string& text, double low, double high);
int wholeWithin(const std::string& option, const std::string& text, int low, int high);

/// Calls `take` for each pair of option and value. False if help was asked for. Throws
/// std::invalid_argument for an option without a value, or with an empty one, and one for which `take` says
/// false.
template <typename Take>
bool readArguments(const std::vector<std::string>& arguments, const Take& take);

[[noreturn]] void rejectMissingValue(const std::string& option);
[[noreturn]] void rejectUnknown(const std::string& option);

template <typename Take>
bool readArguments(const std::vector<std::string>& arguments, const Take& take) {
  for (std::size_t i = 0; i < arguments.size(); i += 2) {
    if (arguments[i] == "--help" || arguments[i] == "-h") return false;
    const bool has_value = i + 1 < arguments.size() && !arguments[i + 1].empty();
    bool known = true;
    try {
      known = take(arguments[i], has_value ? arguments[i + 1] : std::string());
    } catch (const std::invalid_argument&) {
      if (has_value) throw;
    }
    if (!known) rejectUnknown(arguments[i]);
    if (!has_value) rejectMissingValue(arguments[i]);
  }
  return true;
}

/// The main() of a tool. `parse` makes an optional of its options from the arguments, empty if help was asked
/// for. Status 1 and one line with the tool's name for what `parse` or `run` throws.
template <typename Parse, typename Help, typename Run>
int runTool(const char* name, int argc, char** argv, const Parse& parse, const Help& help, const Run& run) {
  try {
    const auto options = parse(std::vector<std::string>(argv + 1, argv + argc));
    if (options) {
      run(*options);
    } else {
      help();
    }
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", name, error.what());
    return 1;
  }
}

}  // namespace sunlit::tools
