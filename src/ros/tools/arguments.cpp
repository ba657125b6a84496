#include "ros/tools/arguments.h"

#include <cmath>
#include <filesystem>
#include <iomanip>
#include <sstream>
#include <stdexcept>

namespace sunlit::tools {

void reject(const std::string& option, const std::string& value, const std::string& allowed) {
  throw std::invalid_argument(option + " is \"" + value + "\", must be " + allowed);
}

void rejectMissingValue(const std::string& option) {
  throw std::invalid_argument(option + " needs a value; --help lists all options");
}

void rejectUnknown(const std::string& option) {
  throw std::invalid_argument("there is no option " + option + "; --help lists all");
}

namespace {

std::string wantedNumbers(std::pair<std::size_t, std::size_t> count, char separator) {
  if (count.second == 1) return "a number";
  const std::string least = count.first == count.second ? "" : std::to_string(count.first) + " to ";
  return least + std::to_string(count.second) + " numbers separated by '" + separator + "'";
}

}  // namespace

void requireFile(const std::string& option, const std::string& file, const std::string& ending) {
  const bool ends = file.size() > ending.size() &&
                    file.compare(file.size() - ending.size(), std::string::npos, ending) == 0;
  if (!ends) reject(option, file, "a name that ends in " + ending);
  requireFolderOf(option, file);
}

void requireFolderOf(const std::string& option, const std::string& file) {
  const std::filesystem::path folder = std::filesystem::path(file).parent_path();
  std::error_code error;
  if (!folder.empty() && !std::filesystem::is_directory(folder, error))
    reject(option, file, "in a folder that exists");
}

std::vector<double> numbers(const std::string& option, const std::string& text,
                            std::pair<std::size_t, std::size_t> count, char separator) {
  const std::string wanted = wantedNumbers(count, separator);
  std::vector<double> values;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, separator);) {
    std::size_t used = 0;
    double value = 0.0;
    try {
      value = std::stod(part, &used);
    } catch (const std::exception&) {
      reject(option, text, wanted);
    }
    if (used != part.size() || !std::isfinite(value)) reject(option, text, wanted);
    values.push_back(value);
  }
  if (values.size() < count.first || values.size() > count.second) reject(option, text, wanted);
  return values;
}

double numberWithin(const std::string& option, const std::string& text, double low, double high) {
  const double value = numbers(option, text, {1, 1})[0];
  if (value < low || value > high) {
    std::ostringstream range;
    range << std::setprecision(10) << low << " ... " << high;
    reject(option, text, range.str());
  }
  return value;
}

int wholeWithin(const std::string& option, const std::string& text, int low, int high) {
  const double value = numberWithin(option, text, low, high);
  if (value != std::floor(value)) reject(option, text, "a whole number");
  return static_cast<int>(value);
}

}  // namespace sunlit::tools
