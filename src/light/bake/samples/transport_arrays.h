/// All that a bake leaves behind, array by array.
#pragma once

#include "light/bake/samples/transport_data.h"

namespace sunlit::light {

/// Calls `visit` with each array of a TransportData, in the order of the file.
template <typename Data, typename Visit>
void visitArrays(Data& data, const Visit& visit) {
  visit(data.mesh.roots);
  visit(data.mesh.cells);
  visit(data.mesh.first_share);
  visit(data.mesh.shares);
  visit(data.direct.rows);
  visit(data.direct.scales);
  visit(data.direct_tints);
  for (auto* part : {&data.above, &data.below}) {
    visit(part->coefficients.rows);
    visit(part->coefficients.scales);
    visit(part->tints);
    visit(part->glows);
    visit(part->hides);
  }
  visit(data.leaves.first);
  visit(data.leaves.grids);
  visit(data.lamps.first);
  visit(data.lamps.blocks);
  visit(data.lamps.light);
  visit(data.rooms.samples);
  visit(data.rooms.first);
  visit(data.rooms.below);
  visit(data.rooms.scales);
  visit(data.rooms.links);
  visit(data.rooms.link_tints);
  visit(data.rooms.mirrored.rows);
  visit(data.rooms.mirrored.scales);
  visit(data.rooms.mirrored_tints);
  visit(data.rooms.sources);
  visit(data.rooms.points);
  visit(data.rooms.glossy);
  visit(data.compact_sources);
}

}  // namespace sunlit::light
