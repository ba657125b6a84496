/// The strip along the track: asphalt with its markings and wear, kerbs, and the verge.
#pragma once

#include "scene/race_track/assembly.h"

namespace sunlit::scene::race_track {

/// A red-and-white kerb on one side of the asphalt.
struct Kerb {
  double from;   ///< along, m
  double to;     ///< along, m
  int side;      ///< +1 left, −1 right
  double width;  ///< m
};
/// All kerbs: inside of the bends and outside of their ends.
const std::vector<Kerb>& kerbs();

/// Width of the kerb there, m; 0 where there is none.
double kerbWidth(double along, int side);

void addRoad(Assembly& assembly);

}  // namespace sunlit::scene::race_track
