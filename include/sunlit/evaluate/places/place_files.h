/// What an evaluation of places leaves in its folder. Each file is there whole or not at all; each function
/// throws std::runtime_error with path and reason.
#pragma once

#include <string>
#include <vector>

#include "sunlit/evaluate/places/place_scores.h"

namespace sunlit::evaluate {

/// One row of places.csv.
struct PlaceRow {
  std::string method;
  PlaceScores scores;
};

/// Columns: method, queries, recall_1, recall_5, recall_10, pr_auc, recall_at_100_precision, without_truth.
void writePlaces(const std::string& path, const std::vector<PlaceRow>& rows);

/// The names of the pictures beside a matrix.
struct MatrixNames {
  std::vector<std::string> queries;
  std::vector<std::string> places;
};
/// A header `query` and the names of the map, then a row for each query: its name and its distances; `inf`
/// where a place is no candidate.
void writeMatrix(const std::string& path, const PlaceMatrix& matrix, const MatrixNames& names);
/// 8-bit grey PNG, one pixel each: query downwards, place to the right. From 0, the least finite distance, in
/// even steps to 255, the greatest; 255 too where a place is no candidate; 0 where all are equal.
void drawMatrix(const std::string& path, const PlaceMatrix& matrix);

}  // namespace sunlit::evaluate
