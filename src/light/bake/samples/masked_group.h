/// Masked triangles among those that the ray library has.
#pragma once

#include <cstdint>
#include <vector>

#include "light/geometry/cutout.h"
#include "light/geometry/embree.h"

namespace sunlit::light {

/// User data of a mesh of them.
struct MaskedGroup {
  const Cutouts* cutouts;
  std::vector<std::uint32_t> masked;  ///< index into Cutouts::maskedTriangles(), by Embree's number
};

/// Calls visit(surface, i) for each hit i that has not been turned down.
template <typename Visit>
void eachMasked(const RTCFilterFunctionNArguments& at, const Visit& visit) {
  const auto& group = *static_cast<const MaskedGroup*>(at.geometryUserPtr);
  for (unsigned i = 0; i < at.N; ++i) {
    if (at.valid[i] == -1)
      visit(Cutouts::Query(*group.cutouts, group.masked[RTCHitN_primID(at.hit, at.N, i)]), i);
  }
}

}  // namespace sunlit::light
