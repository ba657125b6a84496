#include "evaluate/verify/measures.h"

#include <type_traits>

#include "evaluate/files/pair_rows.h"

namespace sunlit::evaluate {
namespace {

std::string within(const std::string& name, double distance_px) {
  return name + "_" + std::to_string(static_cast<int>(distance_px)) + "px";
}

std::vector<Measure> allMeasures() {
  std::vector<Measure> all = {
      {"features_a", [](Verified& v) { return &v.difference.features_a; }},
      {"features_b", [](Verified& v) { return &v.difference.features_b; }},
      {"repeatability", [](Verified& v) { return &v.repeatability; }},
      {within("matching_score", kCorrectWithin_px), [](Verified& v) { return &v.matching_score; }}};
  for (std::size_t t = 0; t < kAccuracySteps; ++t) {
    all.push_back(
        {within("mma", static_cast<double>(t + 1)), [t](Verified& v) { return &v.matching_accuracy[t]; }});
  }
  const std::vector<Measure> others = {
      {"mutual_matches", [](Verified& v) { return &v.mutual_matches; }},
      {"ratio_matches", [](Verified& v) { return &v.difference.matches; }},
      {within("precision", kCorrectWithin_px), [](Verified& v) { return &v.precision; }},
      {within("recall", kCorrectWithin_px), [](Verified& v) { return &v.recall; }},
      {within("average_precision", kCorrectWithin_px), [](Verified& v) { return &v.average_precision; }},
      {"d", [](Verified& v) { return &v.difference.value; }},
      {"d_symmetric", [](Verified& v) { return &v.difference.symmetric; }},
      {"d_one_to_one", [](Verified& v) { return &v.difference.one_to_one; }}};
  all.insert(all.end(), others.begin(), others.end());
  return all;
}

}  // namespace

double Measure::of(const Verified& verified) const {
  Verified copy = verified;
  return std::visit([](const auto* number) { return static_cast<double>(*number); }, place(copy));
}

void Measure::read(const std::string& text, Verified& verified) const {
  std::visit(
      [&](auto* number) {
        if constexpr (std::is_same_v<decltype(number), double*>) {
          *number = parseNumber(text);
        } else {
          *number = parseCount(text);
        }
      },
      place(verified));
}

const std::vector<Measure>& measures() {
  static const std::vector<Measure> all = allMeasures();
  return all;
}

}  // namespace sunlit::evaluate
