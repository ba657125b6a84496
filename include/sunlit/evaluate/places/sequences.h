/// Places found by short sequences of pictures instead of single ones: SeqSLAM (M. J. Milford, G. F. Wyeth,
/// "SeqSLAM: Visual Route-Based Navigation for Sunny Summer Days and Stormy Winter Nights", ICRA 2012), with
/// the defaults and the offline, centred search of OpenSeqSLAM (N. Sünderhauf, P. Neubert, P. Protzel, "Are
/// We There Yet? Challenging SeqSLAM on a 3000 km Journey Across All Four Seasons", ICRA workshop, 2013).
#pragma once

#include <vector>

#include "sunlit/evaluate/places/place_scores.h"

namespace sunlit::evaluate {

constexpr int kContrastWindow = 10;    // R_window: places i − 5 … i + 5
constexpr int kSequenceSteps = 10;     // d_s: from picture to picture, so that 11 pictures make a sequence
constexpr int kSlowestSteps = 8;       // of the map in one sequence: slope V_min = 0.8
constexpr int kFastestSteps = 12;      // V_max = 1.2; in steps of one, V_step = 0.1
constexpr int kUniquenessWindow = 10;  // R_window around the best place: i − 5 … i + 5

/// The fewest pictures with which sequences can be found.
constexpr int kFewestQueries = kSequenceSteps + 1;
constexpr int kFewestPlaces = kSlowestSteps + 1;

/// (D − mean)/sd of each query's column of the paper (our row) over the window along the map, equation (3);
/// sd divided by n − 1, windows cut at the ends of the map; 0 where sd is 0. Then the least value of all is
/// taken from each, so that none is negative and the ratio below makes sense.
PlaceMatrix enhanceContrast(const PlaceMatrix& differences);

/// Equation (5): for each query and place the least sum along a straight line through both. A line takes one
/// step from query to query and floor(k v) along the map after k, v = 0.8, 0.9 … 1.2, and belongs to the
/// place at which it meets the query. It has its query in its middle; at the ends of the drive the same
/// number of queries is taken from the end on, so that every query has a full line (OpenSeqSLAM gives the
/// first and last five none). Lines that leave the map are none: infinite where no other is left. Throws
/// std::invalid_argument for fewer than kFewestQueries rows or kFewestPlaces columns.
PlaceMatrix sequenceScores(const PlaceMatrix& enhanced);

/// For each query the place of its least score; its doubt is that score over the least one outside of the
/// window around it, the inverse of the paper's μ: in [0, 1]. It is 1 where there is no other to compare
/// with, or where that is 0 too.
std::vector<PlaceGuess> uniquePlaces(const PlaceMatrix& scores);

}  // namespace sunlit::evaluate
