/// The texels of a chart.
#pragma once

#include "render/looks_charts.h"
#include "render/texture_pyramid.h"

namespace sunlit::render {

/// Writes the rectangle of `chart`, gutters included, into `page`: base colour, texture, vertex colours and
/// detail, as a camera sees them whose samples are as large as its texels.
void paintChart(const scene::Scene& scene, const TexturePyramid* texture, const Chart& chart,
                scene::Texture* page);

/// m on the surface that a texel of the chart's own base texture covers, along its shorter side.
double ownTexel(const scene::Mesh& mesh, const scene::Texture& texture, const Chart& chart);

}  // namespace sunlit::render
