#include "sunlit/evaluate/places/sequences.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sunlit/quantity/range.h"

namespace sunlit::evaluate {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Those within `window` around `middle`: [first, end).
struct Neighbourhood {
  Eigen::Index first;
  Eigen::Index end;
  Neighbourhood(Eigen::Index middle, Eigen::Index window, Eigen::Index size)
      : first(std::max<Eigen::Index>(0, middle - window / 2)), end(std::min(size, middle + window / 2 + 1)) {}
};

/// (value − mean)/sd among the values of a neighbourhood.
double contrastOf(const double* row, Eigen::Index at, const Neighbourhood& around) {
  const auto n = static_cast<double>(around.end - around.first);
  double sum = 0.0;
  for (Eigen::Index j = around.first; j < around.end; ++j) sum += row[j];
  const double mean = sum / n;
  double squares = 0.0;
  for (Eigen::Index j = around.first; j < around.end; ++j) squares += (row[j] - mean) * (row[j] - mean);
  return squares > 0.0 ? (row[at] - mean) / std::sqrt(squares / (n - 1.0)) : 0.0;
}

/// How far a line of so many steps of the map in a sequence has come after `k` steps of the queries.
Eigen::Index risenAfter(Eigen::Index k, int steps) {
  return k * steps / kSequenceSteps;  // whole numbers: k v is never a hair below one
}

/// Adds the lines of all slopes that pass `query`.
void scoreQuery(const PlaceMatrix& enhanced, Eigen::Index query, PlaceMatrix* scores) {
  const Eigen::Index last_begin = enhanced.rows() - 1 - kSequenceSteps;
  const Eigen::Index begin = std::clamp<Eigen::Index>(query - kSequenceSteps / 2, 0, last_begin);
  for (int steps = kSlowestSteps; steps <= kFastestSteps; ++steps) {
    for (Eigen::Index start = 0; start + steps < enhanced.cols(); ++start) {
      double sum = 0.0;
      for (Eigen::Index k = 0; k <= kSequenceSteps; ++k)
        sum += enhanced(begin + k, start + risenAfter(k, steps));
      double& score = (*scores)(query, start + risenAfter(query - begin, steps));
      score = std::min(score, sum);
    }
  }
}

/// The least score outside of the window.
double bestBeyond(const double* row, Eigen::Index size, const Neighbourhood& around) {
  double best = kInfinity;
  for (Eigen::Index j = 0; j < size; ++j) {
    if (j < around.first || j >= around.end) best = std::min(best, row[j]);
  }
  return best;
}

}  // namespace

PlaceMatrix enhanceContrast(const PlaceMatrix& differences) {
  PlaceMatrix enhanced(differences.rows(), differences.cols());
  if (enhanced.size() == 0) return enhanced;
  for (Eigen::Index i = 0; i < differences.rows(); ++i) {
    const double* const row = differences.row(i).data();
    for (Eigen::Index j = 0; j < differences.cols(); ++j)
      enhanced(i, j) = contrastOf(row, j, {j, kContrastWindow, differences.cols()});
  }
  const double least = enhanced.minCoeff();
  enhanced.array() -= least;
  return enhanced;
}

PlaceMatrix sequenceScores(const PlaceMatrix& enhanced) {
  require("queries of sequences", static_cast<double>(enhanced.rows()), Range::atLeast(kFewestQueries));
  require("places of sequences", static_cast<double>(enhanced.cols()), Range::atLeast(kFewestPlaces));
  PlaceMatrix scores = PlaceMatrix::Constant(enhanced.rows(), enhanced.cols(), kInfinity);
  for (Eigen::Index query = 0; query < enhanced.rows(); ++query) scoreQuery(enhanced, query, &scores);
  return scores;
}

std::vector<PlaceGuess> uniquePlaces(const PlaceMatrix& scores) {
  std::vector<PlaceGuess> guesses = nearestPlaces(scores);
  for (std::size_t i = 0; i < guesses.size(); ++i) {
    if (!guesses[i].place) continue;
    const double* const row = scores.row(static_cast<Eigen::Index>(i)).data();
    const Neighbourhood around(static_cast<Eigen::Index>(*guesses[i].place), kUniquenessWindow,
                               scores.cols());
    const double second = bestBeyond(row, scores.cols(), around);
    const bool is_comparable = std::isfinite(second) && second > 0.0;
    guesses[i].doubt = is_comparable ? guesses[i].doubt / second : 1.0;
  }
  return guesses;
}

}  // namespace sunlit::evaluate
