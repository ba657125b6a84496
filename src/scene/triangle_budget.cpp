#include "scene/triangle_budget.h"

#include <stdexcept>

#include "sunlit/quantity/range.h"
#include "sunlit/scene/scene.h"

namespace sunlit::scene {
namespace {

void require(const char* things, std::uint64_t count, std::uint64_t most, const std::string& where) {
  if (count <= most) return;
  throw std::runtime_error(refusal(where + ": the number of " + things + " up to here", std::to_string(count),
                                   "from 0 to " + std::to_string(most)));
}

}  // namespace

void TriangleBudget::take(std::uint64_t triangles, std::uint64_t vertices, const std::string& where) {
  // Numbers that files tell are below 2^32 each, so that no sum of those that were let through overflows.
  triangles_ += triangles;
  vertices_ += vertices;
  require("triangles", triangles_, kMostTriangles, where);
  require("vertices", vertices_, kMostVertices, where);
}

}  // namespace sunlit::scene
