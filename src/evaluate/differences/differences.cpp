#include "sunlit/evaluate/differences/differences.h"

#include <algorithm>

#include "evaluate/differences/built_in.h"
#include "sunlit/evaluate/differences/feature_difference.h"
#include "sunlit/quantity/range.h"

namespace sunlit::evaluate {

namespace {

/// Names stand in files, keys and topics.
bool isWord(const std::string& name) {
  const std::string letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";
  return !name.empty() && letters.find(name.front()) != std::string::npos &&
         name.find_first_not_of(letters + "0123456789_") == std::string::npos;
}

}  // namespace

Differences::Differences() {
  // Of pixels, one row each. In the order of the paper's tables.
  add("boolean_rgb", makeBoolean(Channels::kRgb));
  add("boolean_grey", makeBoolean(Channels::kGrey));
  add("euclidean_rgb", makeEuclidean(Channels::kRgb));
  add("euclidean_grey", makeEuclidean(Channels::kGrey));
  for (const std::string& type : detectorTypes()) add(type, makeFeatureDifference(makeDetector(type)));
}

Differences::Differences(const Differences& other) {
  for (const auto& item : other.all_) all_.emplace_back(item.first, item.second->clone());
}

Differences& Differences::operator=(const Differences& other) {
  return *this = Differences(other);
}

void Differences::add(const std::string& name, std::unique_ptr<Difference> difference) {
  if (!isWord(name))
    refuse("the name of a difference", '"' + name + '"', "letters, digits and _, first a letter");
  for (const auto& item : all_) {
    if (item.first == name)
      refuse("the name of a difference", '"' + name + '"', "none of " + textOf(names()));
  }
  all_.emplace_back(name, std::move(difference));
}

std::vector<std::string> Differences::names() const {
  std::vector<std::string> names;
  for (const auto& item : all_) names.push_back(item.first);
  return names;
}

std::vector<std::string> Differences::namesOfDetectors() const {
  std::vector<std::string> names;
  for (const auto& item : all_) {
    if (item.second->detector() != nullptr) names.push_back(item.first);
  }
  return names;
}

const Difference& Differences::at(const std::string& name) const {
  for (const auto& item : all_) {
    if (item.first == name) return *item.second;
  }
  refuse("difference", '"' + name + '"', "one of " + textOf(names()));
}

std::vector<Field> Differences::fieldsOf(const std::vector<std::string>& names) {
  std::vector<Field> rows;
  for (const auto& [name, difference] : all_) {
    if (std::count(names.begin(), names.end(), name) == 0) continue;
    const std::string group = difference->detector() != nullptr ? "features/" : "pixels/";
    for (Field& row : under(group + name, difference->fields())) rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<std::string> paperDifferences() {
  return {"boolean_rgb", "boolean_grey", "euclidean_rgb", "euclidean_grey",
#ifdef SUNLIT_SIFT
          "sift",
#endif
#ifdef SUNLIT_SURF
          "surf",
#endif
          "orb",         "brisk"};
}

Choices someOf(const Differences& known, std::vector<std::string>* names) {
  return {known.names(), [names] { return *names; },
          [names](const std::vector<std::string>& some) { *names = some; }};
}

}  // namespace sunlit::evaluate
