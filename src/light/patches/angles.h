/// Angles that light is computed with.
#pragma once

namespace sunlit::light {

/// rad; π (3 − √5). Point i of n of a Fibonacci spiral lies i golden angles round: the points fill a disc, a
/// cap or the sphere evenly.
constexpr double kGoldenAngle = 2.39996322972865332;

}  // namespace sunlit::light
