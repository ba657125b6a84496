#include "light/bake/samples/transport_data.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "light/bake/samples/transport_arrays.h"
#include "sunlit/quantity/angle.h"
#include "sunlit/quantity/vector_clones.h"

namespace sunlit::light {
namespace {

/// Of values ≥ 0.
SUNLIT_WIDE_VECTOR_CLONES
float largestOf(const float* row) {
  constexpr std::size_t kLanes = 16;
  static_assert(SkyPatches::kCount % kLanes == 0, "no rest");
  float lanes[kLanes] = {};
  for (std::size_t p = 0; p < SkyPatches::kCount; p += kLanes)
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      lanes[lane] = row[p + lane] > lanes[lane] ? row[p + lane] : lanes[lane];
  return *std::max_element(lanes, lanes + kLanes);
}

/// Sums are rounded, not values: most of a row may be of many patches, each less than half a step.
void roundTimes(float factor, const float* row, std::uint8_t* to) {
  float sum = 0.0f;
  int before = 0;
  for (std::size_t p = 0; p < SkyPatches::kCount; ++p) {
    sum += row[p] * factor;
    const int up_to_here = static_cast<int>(sum + 0.5f);
    to[p] = static_cast<std::uint8_t>(std::min(up_to_here - before, 255));
    before = up_to_here;
  }
}

}  // namespace

const std::vector<Eigen::Vector3f>& TransportData::places(const Geometry& geometry) const {
  std::call_once(places_found_, [&] {
    places_.assign(sampleCount(), Eigen::Vector3f::Zero());
    struct Part {
      std::uint32_t cell;
      std::array<Eigen::Vector3f, 3> corners;
    };
    std::vector<Part> parts;
    for (std::size_t t = 0; t < mesh.roots.size(); ++t) {
      for (const std::uint32_t root : mesh.roots[t]) {
        if (!LightMesh::isCell(root)) continue;
        const auto& corners = geometry.triangles[t];
        parts.push_back({root,
                         {geometry.positions[corners[0]], geometry.positions[corners[1]],
                          geometry.positions[corners[2]]}});
      }
      while (!parts.empty()) {
        const Part part = parts.back();
        parts.pop_back();
        const LightMesh::Cell& cell = mesh.cells[part.cell];
        if (!cell.inner()) {
          for (std::size_t k = 0; k < 3; ++k) {
            for (std::uint32_t s = mesh.first_share[cell.corner[k]]; s < mesh.first_share[cell.corner[k] + 1];
                 ++s)
              places_[mesh.shares[s].sample] = part.corners[k];
          }
          continue;
        }
        // As locate() has it.
        const std::size_t k = cell.edge();
        const Eigen::Vector3f &from = part.corners[k], &to = part.corners[(k + 1) % 3],
                              &apex = part.corners[(k + 2) % 3];
        const Eigen::Vector3f point = cell.point(from, to);
        parts.push_back({cell.child(), {from, point, apex}});
        parts.push_back({cell.child() + 1, {point, to, apex}});
      }
    }
  });
  return places_;
}

void Coefficients::resize(std::size_t samples) {
  rows.assign(samples * SkyPatches::kCount, 0);
  scales.assign(samples, 0.0f);
}

void Coefficients::set(std::size_t sample, const float* row) {
  const float largest = largestOf(row);
  scales[sample] = largest / 255.0f;
  const float inverse = largest > 0.0f ? 255.0f / largest : 0.0f;
  roundTimes(inverse, row, rows.data() + sample * SkyPatches::kCount);
}

void Coefficients::copy(const Coefficients& others, std::size_t from, std::size_t sample) {
  std::copy_n(others.row(from), SkyPatches::kCount, rows.data() + sample * SkyPatches::kCount);
  scales[sample] = others.scales[from];
}

float Coefficients::sum(std::size_t sample) const {
  std::uint32_t sum = 0;
  for (int p = 0; p < SkyPatches::kCount; ++p) sum += row(sample)[p];
  return static_cast<float>(sum) * scales[sample];
}

void PassedOn::resize(std::size_t samples) {
  coefficients.resize(samples);
  tints.assign(samples, {1.0f, 1.0f, 1.0f});
  glows.assign(samples, {0.0f, 0.0f, 0.0f});
  hides.assign(samples, 0.0f);
}

void TransportData::letGo() const {
  visitArrays(*this, [](const auto& values) { values.letGo(0, values.size()); });
}

void TransportData::letGoOfRows(std::size_t begin, std::size_t end) const {
  for (const Coefficients* part : {&direct, &above.coefficients, &below.coefficients})
    part->rows.letGo(begin * SkyPatches::kCount, end * SkyPatches::kCount);
}

std::vector<float> openSky(const TransportData& data) {
  std::vector<float> of_samples(data.sampleCount()), of_nodes(data.mesh.nodeCount());
  tbb::parallel_for(std::size_t{0}, of_samples.size(), [&](std::size_t i) {
    const float below = static_cast<float>(data.direct.row(i)[SkyPatches::kBelow]) * data.direct.scales[i];
    of_samples[i] = (data.direct.sum(i) - below) / kPiFloat;
  });
  const LightMesh& mesh = data.mesh;
  tbb::parallel_for(std::size_t{0}, of_nodes.size(), [&](std::size_t n) {
    for (std::uint32_t s = mesh.first_share[n]; s < mesh.first_share[n + 1]; ++s)
      of_nodes[n] += mesh.shares[s].weight * of_samples[mesh.shares[s].sample];
  });
  return of_nodes;
}

std::shared_ptr<const GlintNodes> glintNodes(const TransportData& data) {
  const BakedRooms& rooms = data.rooms;
  if (rooms.glossy.empty()) return nullptr;
  GlintNodes nodes{std::vector<float>(data.mesh.nodeCount(), 0.0f), 0.0f};
  std::vector<char> glossy(data.sampleCount(), 0);
  for (const BakedRooms::Glossy& one : rooms.glossy) {
    glossy[rooms.samples[one.room]] = 1;
    nodes.roughness += one.roughness / static_cast<float>(rooms.glossy.size());
  }
  for (std::size_t n = 0; n < nodes.shares.size(); ++n) {
    for (std::uint32_t s = data.mesh.first_share[n]; s < data.mesh.first_share[n + 1]; ++s)
      if (glossy[data.mesh.shares[s].sample] != 0) nodes.shares[n] += data.mesh.shares[s].weight;
  }
  return std::make_shared<const GlintNodes>(std::move(nodes));
}

SUNLIT_WIDE_VECTOR_CLONES
void addTimes(float factor, const std::uint8_t* coefficients, float* __restrict row) {
  for (std::size_t p = 0; p < SkyPatches::kCount; ++p) row[p] += factor * static_cast<float>(coefficients[p]);
}

}  // namespace sunlit::light
