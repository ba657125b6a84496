/// Nodes spread evenly over a triangle.
#pragma once

#include <algorithm>
#include <array>

namespace sunlit::light {

/// A node by its number of steps from the first corner towards the second and towards the third.
struct GridNode {
  int second, third;
};

/// The three nodes around a point of a triangle whose edges are divided into `steps`, and their weights,
/// which sum to 1.
struct GridPlace {
  std::array<GridNode, 3> node;
  std::array<float, 3> weight;

  /// Of the point at these barycentric coordinates of second and third corner.
  GridPlace(float second, float third, int steps) {
    const float u = second * static_cast<float>(steps), v = third * static_cast<float>(steps);
    const int i = std::clamp(static_cast<int>(u), 0, steps - 1);
    const int j = std::clamp(static_cast<int>(v), 0, steps - 1 - i);
    const float x = u - static_cast<float>(i), y = v - static_cast<float>(j);
    if (x + y <= 1.0f || i + j + 2 > steps) {
      node = {{{i, j}, {i + 1, j}, {i, j + 1}}};
      weight = {1.0f - x - y, x, y};
    } else {
      node = {{{i + 1, j + 1}, {i + 1, j}, {i, j + 1}}};
      weight = {x + y - 1.0f, 1.0f - y, 1.0f - x};
    }
  }
};

}  // namespace sunlit::light
