/// Gauss-Legendre quadrature.
#pragma once

#include <cmath>
#include <vector>

#include "sunlit/quantity/angle.h"

namespace sunlit::sky {

struct Node {
  double x, weight;
};

/// Nodes of `count` ≥ 1 points over [low, high]; weights sum to its length. Newton's method on the Legendre
/// polynomial (Press et al., Numerical Recipes, 4.6).
inline std::vector<Node> gaussLegendre(int count, double low, double high) {
  std::vector<Node> nodes;
  for (int i = 0; i < count; ++i) {
    double x = std::cos(kPi * (i + 0.75) / (count + 0.5));
    double slope = 1.0;
    for (int step = 0; step < 20; ++step) {
      double p = 1.0;
      double before = 0.0;
      for (int n = 1; n <= count; ++n) {
        const double next = ((2.0 * n - 1.0) * x * p - (n - 1.0) * before) / n;
        before = p;
        p = next;
      }
      slope = count * (x * p - before) / (x * x - 1.0);
      x -= p / slope;
    }
    nodes.push_back(
        {0.5 * (low + high) + 0.5 * (high - low) * x, (high - low) / ((1.0 - x * x) * slope * slope)});
  }
  return nodes;
}

}  // namespace sunlit::sky
