#include "sunlit/evaluate/places/place_scores.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace sunlit::evaluate {
namespace {

/// The pictures of the map that belong to one query: [first, end).
struct Truth {
  std::size_t first = 0;
  std::size_t end = 0;
  bool exists() const { return first < end; }
  bool holds(std::size_t place) const { return place >= first && place < end; }
};

Truth truthOf(std::size_t query, std::size_t places, std::size_t tolerance) {
  const std::size_t first = query > tolerance ? query - tolerance : 0;
  const std::size_t after = tolerance < places ? std::min(places, query + tolerance + 1) : places;
  return {std::min(first, places), after};
}

std::size_t placesOf(const PlaceMatrix& distances) {
  return static_cast<std::size_t>(distances.cols());
}

/// How many places come before the nearest true one; nothing where none is a candidate.
std::optional<std::size_t> rankOfTruth(const PlaceMatrix& distances, std::size_t query,
                                       std::size_t tolerance) {
  const double* const row = distances.row(static_cast<Eigen::Index>(query)).data();
  const Truth truth = truthOf(query, placesOf(distances), tolerance);
  if (!truth.exists()) return std::nullopt;
  const std::size_t best =
      static_cast<std::size_t>(std::min_element(row + truth.first, row + truth.end) - row);
  if (!std::isfinite(row[best])) return std::nullopt;
  std::size_t before = 0;
  for (std::size_t j = 0; j < placesOf(distances); ++j)
    before += row[j] < row[best] || (row[j] == row[best] && j < best) ? 1 : 0;
  return before;
}

double share(std::size_t part, std::size_t whole) {
  return static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

std::vector<PlaceGuess> nearestPlaces(const PlaceMatrix& distances) {
  std::vector<PlaceGuess> guesses(static_cast<std::size_t>(distances.rows()));
  for (std::size_t i = 0; i < guesses.size(); ++i) {
    const double* const row = distances.row(static_cast<Eigen::Index>(i)).data();
    const double* const least = std::min_element(row, row + distances.cols());
    if (std::isfinite(*least)) guesses[i] = {static_cast<std::size_t>(least - row), *least};
  }
  return guesses;
}

std::vector<CurvePoint> precisionRecallCurve(const std::vector<PlaceGuess>& guesses, std::size_t places,
                                             std::size_t tolerance) {
  std::vector<std::pair<double, bool>> judged;  // doubt, and whether the guess is right
  std::size_t with_truth = 0;
  for (std::size_t i = 0; i < guesses.size(); ++i) {
    const Truth truth = truthOf(i, places, tolerance);
    with_truth += truth.exists() ? 1 : 0;
    if (guesses[i].place) judged.emplace_back(guesses[i].doubt, truth.holds(*guesses[i].place));
  }
  std::sort(judged.begin(), judged.end());
  std::vector<CurvePoint> curve(1);
  std::size_t right = 0;
  for (std::size_t k = 0; k < judged.size(); ++k) {
    right += judged[k].second ? 1 : 0;
    const bool is_last_of_its_doubt = k + 1 == judged.size() || judged[k + 1].first != judged[k].first;
    if (is_last_of_its_doubt) curve.push_back({share(right, with_truth), share(right, k + 1)});
  }
  return curve;
}

double areaUnder(const std::vector<CurvePoint>& curve) {
  double area = 0.0;
  for (std::size_t k = 1; k < curve.size(); ++k) {
    area += (curve[k].recall - curve[k - 1].recall) * (curve[k].precision + curve[k - 1].precision) / 2.0;
  }
  return area;
}

double recallAtFullPrecision(const std::vector<CurvePoint>& curve) {
  double recall = 0.0;
  for (const CurvePoint& point : curve) {
    if (point.precision == 1.0) recall = std::max(recall, point.recall);
  }
  return recall;
}

PlaceScores placeScores(const PlaceMatrix& distances, const std::vector<PlaceGuess>& guesses,
                        std::size_t tolerance) {
  PlaceScores scores;
  scores.queries = guesses.size();
  if (distances.size() == 0 || static_cast<std::size_t>(distances.rows()) != guesses.size()) {
    throw std::invalid_argument("places: " + std::to_string(guesses.size()) + " guesses for distances of " +
                                std::to_string(distances.rows()) + " queries to " +
                                std::to_string(distances.cols()) +
                                " places, but must be one for each query, and at least one of each");
  }
  std::size_t within_1 = 0, within_5 = 0, within_10 = 0;
  for (std::size_t i = 0; i < guesses.size(); ++i) {
    scores.without_truth += truthOf(i, placesOf(distances), tolerance).exists() ? 0 : 1;
    scores.without_guess += guesses[i].place ? 0 : 1;
    const std::optional<std::size_t> rank = rankOfTruth(distances, i, tolerance);
    within_1 += rank && *rank < 1 ? 1 : 0;
    within_5 += rank && *rank < 5 ? 1 : 0;
    within_10 += rank && *rank < 10 ? 1 : 0;
  }
  scores.recall_1 = share(within_1, scores.queries);
  scores.recall_5 = share(within_5, scores.queries);
  scores.recall_10 = share(within_10, scores.queries);
  const std::vector<CurvePoint> curve = precisionRecallCurve(guesses, placesOf(distances), tolerance);
  scores.pr_auc = areaUnder(curve);
  scores.recall_at_100_precision = recallAtFullPrecision(curve);
  return scores;
}

}  // namespace sunlit::evaluate
