/// The command line of `evaluate_pair`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sunlit/evaluate/verify/verify.h"
#include "sunlit/quantity/field.h"

namespace sunlit::tools {

struct EvaluatePairOptions {
  std::string a;  ///< files
  std::string b;
  std::string homography;  ///< file; empty: pixels of equal place show the same
  std::string output;      ///< folder
  double features_cache_gb = evaluate::kUsualFeaturesCache_gb;
  evaluate::VerifyOptions verify;
};

inline std::vector<Field> fieldsOf(EvaluatePairOptions& options) {
  return {
      {"out", &options.output, "", {}, "folder for verified.csv"},
      {"homography",
       &options.homography,
       "",
       {},
       "three lines of three numbers that map pixels of A to pixels of B; without it pixels of equal place "
       "show the same"},
      evaluate::featuresCacheRow(&options.features_cache_gb)};
}

/// Empty if help was asked for, and has been printed. Throws std::invalid_argument naming the option, its
/// value and what is allowed.
std::optional<EvaluatePairOptions> parseEvaluatePairOptions(const std::vector<std::string>& arguments);

}  // namespace sunlit::tools
