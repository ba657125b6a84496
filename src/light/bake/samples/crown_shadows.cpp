#include "light/bake/samples/crown_shadows.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <utility>

#include "sunlit/light/surfaces.h"
#include "sunlit/quantity/vector_clones.h"

namespace sunlit::light {
namespace {

/// So far off their leaf points lie.
float clearance_m(const Eigen::Vector3f& point) {
  return std::max(1e-3f, rayClearance_m(point, 0.0f));
}
constexpr float kEdgeOn = 1e-4f;  ///< cosine below which a triangle hides nothing
/// After each of so many parts of the triangles, points that are shaded by then are dropped.
constexpr std::size_t kParts = 4;
constexpr std::size_t kLanes = 32;                    ///< points that meet a triangle at once
constexpr std::size_t kWord = sizeof(std::uint64_t);  ///< answers looked at together
constexpr float kMostCells = 512.0f;                  ///< an axis: leaves may be as large as they like
constexpr float kShaded = std::numeric_limits<float>::infinity();

/// A step that visits all of `count` things in an order without any order.
std::size_t scatteredStep(std::size_t count) {
  std::size_t step = count * 8 / 13 | 1u;
  while (std::gcd(step, count) != 1) ++step;
  return step;
}

/// Of a triangle's second and third corner, at a point.
struct Shares {
  float u, v;
};

}  // namespace

/// A triangle as seen along the light, where its shares and its height are linear.
struct CrownShadows::Shadow {
  float x, y, height;                 ///< of the first corner
  float u_x, u_y, v_x, v_y;           ///< what steps add to the shares
  float second_height, third_height;  ///< of the other corners, above the first
  std::int32_t masked;

  Shares at(float at_x, float at_y) const {
    const float dx = at_x - x, dy = at_y - y;
    return {dx * u_x + dy * u_y, dx * v_x + dy * v_y};
  }
};

struct CrownShadows::Arrays {
  const float *x, *y, *height;
};

/// Sets hit[i] to 1 where the triangle lies before a point, else to 0. Returns whether there are any.
SUNLIT_VECTOR_CLONES
bool CrownShadows::meet(const Shadow& shadow, const Arrays& points, std::size_t count, std::uint8_t* hit) {
  const Shadow s = shadow;
  const Arrays p = points;
  std::uint8_t any = 0;
  const std::size_t end = (count + kLanes - 1) / kLanes * kLanes;  // no loop for a rest
  for (std::size_t i = 0; i < end; ++i) {
    const float dx = p.x[i] - s.x, dy = p.y[i] - s.y;
    const float u = dx * s.u_x + dy * s.u_y, v = dx * s.v_x + dy * s.v_y;
    const float above = s.height + u * s.second_height + v * s.third_height - p.height[i];
    const float inside = std::min(std::min(u, v), std::min(1.0f - u - v, above));
    hit[i] = inside >= 0.0f ? 1 : 0;
    any |= hit[i];
  }
  return any != 0;
}

CrownShadows::CrownShadows(const World& world, std::vector<Point> points, float cell_m)
    : world_(world), points_(std::move(points)), cell_m_(cell_m), open_(points_.size()) {
  if (points_.empty()) return;
  for (const Point& point : points_) box_.extend(point.position);
  const float around_m = 2.0f * std::max(clearance_m(box_.min()), clearance_m(box_.max()));
  box_.min().array() -= around_m;
  box_.max().array() += around_m;
  middle_ = box_.center();
  cell_m_ = std::max(cell_m_, box_.diagonal().norm() / kMostCells);
  addBlockers();
}

void CrownShadows::addBlockers() {
  const Geometry& geometry = world_.geometry;
  std::vector<Blocker> found;
  const std::vector<std::uint32_t>& masked = world_.cutouts.maskedTriangles();
  for (const scene::Chunk& chunk : geometry.chunks) {
    if (!chunk.box.intersects(box_)) continue;
    for (std::uint32_t t = chunk.first; t < chunk.first + chunk.count; ++t) {
      Eigen::AlignedBox3f around;
      Blocker blocker;
      for (std::size_t k = 0; k < 3; ++k) {
        const Eigen::Vector3f& corner = geometry.positions[geometry.triangles[t][k]];
        around.extend(corner);
        blocker.corners[k] = corner - middle_;
      }
      if (!around.intersects(box_)) continue;
      blocker.area =
          (blocker.corners[1] - blocker.corners[0]).cross(blocker.corners[2] - blocker.corners[0]).norm();
      const auto at = std::lower_bound(masked.begin(), masked.end(), t);
      blocker.masked =
          at != masked.end() && *at == t ? static_cast<std::int32_t>(at - masked.begin()) : kOpaque;
      found.push_back(blocker);
    }
  }
  if (found.empty()) return;
  // So that every part of them shades points everywhere.
  const std::size_t step = scatteredStep(found.size());
  blockers_.reserve(found.size());
  for (std::size_t i = 0, at = 0; i < found.size(); ++i, at = (at + step) % found.size())
    blockers_.push_back(found[at]);
}

const std::vector<std::uint8_t>& CrownShadows::open(const Eigen::Vector3f& towards) {
  std::fill(open_.begin(), open_.end(), 0);
  if (points_.empty()) return open_;
  project(towards);
  sortIntoCells();
  const std::size_t part = blockers_.size() / kParts + 1;
  for (std::size_t i = 0; i < blockers_.size(); ++i) {
    shade(blockers_[i]);
    if ((i + 1) % part == 0) dropShaded();
  }
  dropShaded();
  lookBeyond(towards);
  return open_;
}

void CrownShadows::project(const Eigen::Vector3f& towards) {
  towards_ = towards;
  across_ = towards.unitOrthogonal();
  up_ = towards.cross(across_);
  const std::size_t count = points_.size();
  for (auto* values : {&unsorted_x_, &unsorted_y_, &unsorted_height_}) values->resize(count);
  float high_x = -kShaded, high_y = -kShaded;
  low_x_ = low_y_ = lowest_ = kShaded;
  for (std::size_t i = 0; i < count; ++i) {
    const Point& point = points_[i];
    const float clear = clearance_m(point.position), side = point.normal.dot(towards) > 0.0f ? clear : -clear;
    const Eigen::Vector3f at = point.position - middle_ + side * point.normal;
    const float x = across_.dot(at), y = up_.dot(at), height = towards.dot(at);
    unsorted_x_[i] = x;
    unsorted_y_[i] = y;
    unsorted_height_[i] = height;
    low_x_ = std::min(low_x_, x);
    high_x = std::max(high_x, x);
    low_y_ = std::min(low_y_, y);
    high_y = std::max(high_y, y);
    lowest_ = std::min(lowest_, height);
  }
  columns_ = static_cast<int>((high_x - low_x_) / cell_m_) + 1;
  rows_ = static_cast<int>((high_y - low_y_) / cell_m_) + 1;
}

void CrownShadows::sortIntoCells() {
  const std::size_t count = points_.size();
  first_.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
  unsorted_cell_.resize(count);
  const float scale = 1.0f / cell_m_;
  for (std::size_t i = 0; i < count; ++i) {
    const int column = std::min(static_cast<int>((unsorted_x_[i] - low_x_) * scale), columns_ - 1);
    const int row = std::min(static_cast<int>((unsorted_y_[i] - low_y_) * scale), rows_ - 1);
    unsorted_cell_[i] = static_cast<std::uint32_t>(row * columns_ + column);
    ++first_[unsorted_cell_[i] + 1];
  }
  for (std::size_t cell = 1; cell < first_.size(); ++cell) first_[cell] += first_[cell - 1];
  for (auto* values : {&x_, &y_, &height_}) values->resize(count + kLanes);
  point_.resize(count);
  hit_.resize(count + kLanes);
  solid_.resize(count);
  met_.resize(count + 1);
  for (auto* values : {&u_, &v_}) values->resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t to = first_[unsorted_cell_[i]]++;
    x_[to] = unsorted_x_[i];
    y_[to] = unsorted_y_[i];
    height_[to] = unsorted_height_[i];
    point_[to] = static_cast<std::uint32_t>(i);
  }
  for (std::size_t cell = first_.size() - 1; cell > 0; --cell) first_[cell] = first_[cell - 1];
  first_[0] = 0;
}

void CrownShadows::shade(const Blocker& blocker) {
  const auto& c = blocker.corners;
  const float height[3] = {towards_.dot(c[0]), towards_.dot(c[1]), towards_.dot(c[2])};
  if (std::max({height[0], height[1], height[2]}) < lowest_) return;
  float x[3], y[3];
  for (std::size_t k = 0; k < 3; ++k) x[k] = across_.dot(c[k]), y[k] = up_.dot(c[k]);
  const float bx = x[1] - x[0], by = y[1] - y[0], cx = x[2] - x[0], cy = y[2] - y[0];
  const float area = bx * cy - by * cx;
  if (!(std::abs(area) > kEdgeOn * blocker.area)) return;
  const float s = 1.0f / area;
  const Shadow shadow{x[0],
                      y[0],
                      height[0],
                      s * cy,
                      -s * cx,
                      -s * by,
                      s * bx,
                      height[1] - height[0],
                      height[2] - height[0],
                      blocker.masked};
  const float low_x = std::min({x[0], x[1], x[2]}), high_x = std::max({x[0], x[1], x[2]});
  const float low_y = std::min({y[0], y[1], y[2]}), high_y = std::max({y[0], y[1], y[2]});
  const float scale = 1.0f / cell_m_, columns = static_cast<float>(columns_),
              rows = static_cast<float>(rows_);
  const float left = (low_x - low_x_) * scale, right = (high_x - low_x_) * scale;
  const float bottom = (low_y - low_y_) * scale, top = (high_y - low_y_) * scale;
  if (left >= columns || right < 0.0f || bottom >= rows || top < 0.0f) return;
  const int first = static_cast<int>(std::max(left, 0.0f));
  const int last = static_cast<int>(std::min(right, columns - 0.5f));
  const int last_row = static_cast<int>(std::min(top, rows - 0.5f));
  for (int row = static_cast<int>(std::max(bottom, 0.0f)); row <= last_row; ++row) {
    const auto* cells = first_.data() + static_cast<std::size_t>(row * columns_);
    if (cells[first] < cells[last + 1]) shade(shadow, cells[first], cells[last + 1]);
  }
}

void CrownShadows::shade(const Shadow& s, std::size_t begin, std::size_t end) {
  std::uint8_t* hit = hit_.data();
  if (!meet(s, {x_.data() + begin, y_.data() + begin, height_.data() + begin}, end - begin, hit)) return;
  std::size_t met = 0;
  for (std::size_t word = 0; word < end - begin; word += kWord) {
    std::uint64_t any;
    std::memcpy(&any, hit + word, kWord);
    if (any == 0) continue;
    for (std::size_t i = word; i < std::min(word + kWord, end - begin); ++i) {
      met_[met] = static_cast<std::uint32_t>(begin + i);
      met += hit[i];
    }
  }
  if (s.masked == kOpaque) {
    for (std::size_t i = 0; i < met; ++i) height_[met_[i]] = kShaded;
    return;
  }
  for (std::size_t i = 0; i < met; ++i) {
    const Shares at = s.at(x_[met_[i]], y_[met_[i]]);
    u_[i] = at.u;
    v_[i] = at.v;
  }
  Cutouts::Query(world_.cutouts, static_cast<std::uint32_t>(s.masked))
      .solid(u_.data(), v_.data(), met, solid_.data());
  for (std::size_t i = 0; i < met; ++i) height_[met_[i]] = solid_[i] ? kShaded : height_[met_[i]];
}

void CrownShadows::dropShaded() {
  std::uint32_t to = 0, from = 0;
  for (std::size_t cell = 0; cell + 1 < first_.size(); ++cell) {
    const std::uint32_t end = first_[cell + 1];
    first_[cell] = to;
    for (; from < end; ++from) {
      if (height_[from] == kShaded) continue;
      x_[to] = x_[from];
      y_[to] = y_[from];
      height_[to] = height_[from];
      point_[to++] = point_[from];
    }
  }
  first_.back() = to;
}

void CrownShadows::lookBeyond(const Eigen::Vector3f& towards) {
  beyond_.clear();
  beyond_.reserve(first_.size() - 1);
  for (std::uint32_t cell = 0; cell + 1 < first_.size(); ++cell) {
    if (first_[cell] == first_[cell + 1]) continue;
    const Eigen::Vector3f& from = points_[point_[(first_[cell] + first_[cell + 1]) / 2]].position;
    float leaves = kShaded;  // the box, after so many metres
    for (int axis = 0; axis < 3; ++axis) {
      if (towards[axis] == 0.0f) continue;
      const float side = towards[axis] > 0.0f ? box_.max()[axis] : box_.min()[axis];
      leaves = std::min(leaves, (side - from[axis]) / towards[axis]);
    }
    beyond_.add(cell, from + leaves * towards, towards);
  }
  blocked_.resize(beyond_.size());
  world_.visibility.occluded(beyond_.rays(), blocked_.data());
  for (std::size_t i = 0; i < beyond_.size(); ++i) {
    if (blocked_[i]) continue;
    const std::uint32_t cell = beyond_.number()[i];
    for (std::uint32_t p = first_[cell]; p < first_[cell + 1]; ++p) open_[point_[p]] = 1;
  }
}

}  // namespace sunlit::light
