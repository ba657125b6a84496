/// What a scene may hold, asked for before it is made.
#pragma once

#include <cstdint>
#include <string>

namespace sunlit::scene {

class TriangleBudget {
 public:
  /// Takes what a mesh needs. Throws std::runtime_error that begins with `where` if all that was taken is
  /// more than kMostTriangles, or than kMostVertices.
  void take(std::uint64_t triangles, std::uint64_t vertices, const std::string& where);

 private:
  std::uint64_t triangles_ = 0, vertices_ = 0;
};

}  // namespace sunlit::scene
