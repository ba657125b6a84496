#include "sunlit/evaluate/features/preprocessing.h"

#include <utility>

#include "evaluate/features/preprocessings.h"
#include "sunlit/quantity/range.h"

namespace sunlit::evaluate {
namespace {

struct PreprocessingRow {
  std::string name;
  std::unique_ptr<Preprocessing> (*make)();
};

const std::vector<PreprocessingRow>& preprocessingTable() {
  static const std::vector<PreprocessingRow> rows = {
      {"clahe", makeClahe}, {"gamma", makeGamma}, {"illumination_invariant", makeIlluminationInvariant}};
  return rows;
}

[[noreturn]] void refusePreprocessing(const std::string& name) {
  refuse("preprocessing", '"' + name + '"', "one of " + textOf(preprocessingNames()));
}

}  // namespace

const std::vector<std::string>& preprocessingNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const PreprocessingRow& row : preprocessingTable()) all.push_back(row.name);
    return all;
  }();
  return names;
}

std::unique_ptr<Preprocessing> makePreprocessing(const std::string& name) {
  for (const PreprocessingRow& row : preprocessingTable()) {
    if (row.name == name) return row.make();
  }
  refusePreprocessing(name);
}

Preprocessings::Preprocessings() {
  for (const PreprocessingRow& row : preprocessingTable()) all_.push_back(row.make());
}

Preprocessings::Preprocessings(const Preprocessings& other) {
  for (const auto& preprocessing : other.all_) all_.push_back(preprocessing->clone());
}

Preprocessings& Preprocessings::operator=(const Preprocessings& other) {
  return *this = Preprocessings(other);
}

const Preprocessing& Preprocessings::at(const std::string& name) const {
  for (std::size_t i = 0; i < all_.size(); ++i) {
    if (preprocessingTable()[i].name == name) return *all_[i];
  }
  refusePreprocessing(name);
}

std::vector<Field> Preprocessings::fields() {
  std::vector<Field> rows;
  for (std::size_t i = 0; i < all_.size(); ++i) {
    for (Field& row : under(preprocessingTable()[i].name, all_[i]->fields())) rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace sunlit::evaluate
