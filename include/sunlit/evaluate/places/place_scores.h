/// How well places are found again: recall among the first N, and precision against recall.
///
/// Queries and map are two drives along one path, each a row of pictures. Picture i of the queries and
/// picture j of the map show the same place where |i − j| ≤ tolerance: index against index, however long
/// either is.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

namespace sunlit::evaluate {

/// How far each query (row) is from each picture of the map (column), both in their order; the least is the
/// nearest, and of equal ones that of the lower index. Infinite: not a candidate. Never NaN.
using PlaceMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// What one query is taken for.
struct PlaceGuess {
  std::optional<std::size_t> place;  ///< picture of the map; empty where there was no candidate
  double doubt = 0.0;                ///< the less, the sooner the guess is accepted
};

/// For each query its nearest place, with the distance as doubt.
std::vector<PlaceGuess> nearestPlaces(const PlaceMatrix& distances);

/// Accepted are all guesses up to some doubt.
struct CurvePoint {
  double recall = 0.0;     ///< right guesses / queries that have a true place
  double precision = 1.0;  ///< right guesses / accepted ones, those of queries without a true place too
};

/// From (0, 1) on, one point for each doubt that occurs, least first: equal doubts are accepted together. The
/// convention of the VPR tutorial of Schubert et al. 2023, but at every threshold instead of 100. `places` is
/// the number of pictures of the map, ≥ 1.
std::vector<CurvePoint> precisionRecallCurve(const std::vector<PlaceGuess>& guesses, std::size_t places,
                                             std::size_t tolerance);
/// By the trapezoid, from recall 0 to the largest that is reached; in [0, 1].
double areaUnder(const std::vector<CurvePoint>& curve);
/// The largest recall with precision 1; 0 where the surest guess is wrong.
double recallAtFullPrecision(const std::vector<CurvePoint>& curve);

struct PlaceScores {
  std::size_t queries = 0;
  /// Share of all queries with a true place among the first 1, 5, 10 of the map by their distance.
  double recall_1 = 0.0, recall_5 = 0.0, recall_10 = 0.0;
  double pr_auc = 0.0;
  double recall_at_100_precision = 0.0;
  /// Queries that no picture of the map belongs to, since they are beyond its end: every recall among the
  /// first N misses them; of the curve they are not in the recall, but their guesses in the precision.
  std::size_t without_truth = 0;
  std::size_t without_guess = 0;  ///< queries without a candidate
};

/// `guesses` has one for each row of `distances`. Throws std::invalid_argument where it has not, or where
/// there are no queries or no places.
PlaceScores placeScores(const PlaceMatrix& distances, const std::vector<PlaceGuess>& guesses,
                        std::size_t tolerance);

}  // namespace sunlit::evaluate
