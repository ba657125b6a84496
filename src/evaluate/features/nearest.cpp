// twoNearestBothWays(): brute force, but only what decides is computed to the last bit, and each distance
// once.
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/core/hal/hal.hpp>
#include <opencv2/features2d.hpp>
#include <stdexcept>
#include <utility>

#include "evaluate/features/distance_rows.h"
#include "sunlit/evaluate/features/matching.h"

namespace sunlit::evaluate {
namespace {

constexpr std::size_t kLanes = 16;
constexpr std::size_t kQueriesPerTask = 64;  // between which the work can be stopped

/// Rows of a matrix in a type of our choice, filled up with zeros to a width that suits the inner loops.
template <typename Value>
struct Table {
  std::vector<Value> values;
  std::size_t rows = 0;
  std::size_t width = 0;
  RowsOf<Value> view() const { return {values.data(), rows, width}; }
  const Value* row(std::size_t i) const { return values.data() + i * width; }
};

using Table16 = Table<std::int16_t>;

// As bytes, or as floats in steps of 1 / scale.
template <typename Source>
Table16 tableOf(const cv::Mat& matrix, [[maybe_unused]] double scale) {
  Table16 table;
  table.rows = static_cast<std::size_t>(matrix.rows);
  const auto columns = static_cast<std::size_t>(matrix.cols);
  table.width = (columns + kLanes - 1) / kLanes * kLanes;
  table.values.assign(table.rows * table.width, 0);
  for (std::size_t i = 0; i < table.rows; ++i) {
    const Source* source = matrix.ptr<Source>(static_cast<int>(i));
    std::int16_t* row = table.values.data() + i * table.width;
    for (std::size_t k = 0; k < columns; ++k) {
      if constexpr (std::is_same_v<Source, uchar>) {
        row[k] = source[k];
      } else {
        row[k] = static_cast<std::int16_t>(std::lround(source[k] * scale));
      }
    }
  }
  return table;
}

Table<std::uint64_t> wordsOf(const cv::Mat& matrix) {
  Table<std::uint64_t> table;
  table.rows = static_cast<std::size_t>(matrix.rows);
  const auto bytes = static_cast<std::size_t>(matrix.cols);
  table.width = (bytes + sizeof(std::uint64_t) - 1) / sizeof(std::uint64_t);
  table.values.assign(table.rows * table.width, 0);
  for (std::size_t i = 0; i < table.rows; ++i) {
    std::memcpy(table.values.data() + i * table.width, matrix.ptr(static_cast<int>(i)), bytes);
  }
  return table;
}

std::vector<std::int32_t> squaredNorms(const Table16& table) {
  std::vector<std::int32_t> norms(table.rows, 0);
  for (std::size_t i = 0; i < table.rows; ++i) {
    const std::int16_t* row = table.row(i);
    for (std::size_t k = 0; k < table.width; ++k) norms[i] += row[k] * row[k];
  }
  return norms;
}

/// The two smallest of a row; of equal ones the first is the best.
template <typename Value>
struct TwoSmallest {
  std::size_t best_at = 0;
  Value best = std::numeric_limits<Value>::max();
  Value second = std::numeric_limits<Value>::max();
  void add(std::size_t at, Value value) {
    if (value >= second) return;
    if (value < best) {
      second = best;
      best = value;
      best_at = at;
    } else {
      second = value;
    }
  }
  /// Takes over what lies behind all of this.
  void append(const TwoSmallest& behind) {
    if (behind.best < best) {
      second = std::min(best, behind.second);
      best = behind.best;
      best_at = behind.best_at;
    } else {
      second = std::min(second, behind.best);
    }
  }
};

template <typename Value>
TwoSmallest<Value> twoSmallest(const Value* row, std::size_t size) {
  TwoSmallest<Value> two;
  for (std::size_t j = 0; j < size; ++j) two.add(j, row[j]);
  return two;
}

/// What tbb::parallel_reduce asks for: `body(first, last, columns)` for ranges of rows, whose columns are
/// appended from left to right, so that the lowest of equally near rows stays the best.
template <typename Columns, typename Body>
class ColumnReduction {
 public:
  ColumnReduction(const Columns& none, const Body& body) : columns(none), none_(none), body_(body) {}
  ColumnReduction(ColumnReduction& other, tbb::split)
      : columns(other.none_), none_(other.none_), body_(other.body_) {}
  void operator()(const tbb::blocked_range<std::size_t>& range) {
    body_(range.begin(), range.end(), columns);
  }
  void join(const ColumnReduction& behind) { columns.append(behind.columns); }

  Columns columns;

 private:
  const Columns& none_;
  const Body& body_;
};

/// Goes through all rows of a, in parallel; the columns that all of them together make.
template <typename Columns, typename Body>
Columns reduceRows(std::size_t rows, const Columns& none, const StopToken& stop, const Body& body) {
  const auto inTasks = [&](std::size_t begin, std::size_t end, Columns& columns) {
    for (std::size_t first = begin; first < end; first += kQueriesPerTask) {
      stop.check();
      body(first, std::min(first + kQueriesPerTask, end), columns);
    }
  };
  ColumnReduction<Columns, decltype(inTasks)> reduction(none, inTasks);
  tbb::parallel_reduce(tbb::blocked_range<std::size_t>(0, rows, kQueriesPerTask), reduction);
  return std::move(reduction.columns);
}

// Squared distances of all pairs, |a − b|² = |a|² + |b|² − 2 a·b, exact in whole numbers; body(i, row,
// columns) for each row i of a.
template <typename Columns, typename Body>
Columns reduceSquaredDistances(const Table16& a, const Table16& b, const StopToken& stop, const Body& body) {
  const std::vector<std::int32_t> norms_a = squaredNorms(a);
  const std::vector<std::int32_t> norms_b = squaredNorms(b);
  return reduceRows(a.rows, Columns(b.rows), stop, [&](std::size_t begin, std::size_t end, Columns& columns) {
    std::vector<std::int32_t> squares(kQueriesAtOnce * b.rows);
    for (std::size_t first = begin; first < end; first += kQueriesAtOnce) {
      const std::int16_t* queries[kQueriesAtOnce];
      for (std::size_t q = 0; q < kQueriesAtOnce; ++q) queries[q] = a.row(std::min(first + q, end - 1));
      dotRows(queries, b.view(), squares.data());
      for (std::size_t i = first; i < std::min(first + kQueriesAtOnce, end); ++i) {
        std::int32_t* row = squares.data() + (i - first) * b.rows;
        for (std::size_t j = 0; j < b.rows; ++j) row[j] = norms_a[i] + norms_b[j] - 2 * row[j];
        body(i, row, columns);
      }
    }
  });
}

float rootOf(std::int32_t square) {
  return std::sqrt(static_cast<float>(square));
}

std::int32_t squaredDistance(const std::int16_t* a, const std::int16_t* b, std::size_t width) {
  std::int32_t sum = 0;
  for (std::size_t k = 0; k < width; ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return sum;
}

// Different squares may have one rounded root; then the first of those rows counts.
int firstAtRoot(const Table16& rows, const std::int16_t* to, float distance) {
  for (std::size_t i = 0; i < rows.rows; ++i) {
    if (rootOf(squaredDistance(rows.row(i), to, rows.width)) == distance) return static_cast<int>(i);
  }
  return -1;
}

Neighbours neighboursOf(const TwoSmallest<std::int32_t>& squares, const Table16& others,
                        const std::int16_t* own) {
  Neighbours n{static_cast<int>(squares.best_at), rootOf(squares.best), rootOf(squares.second)};
  if (n.best_distance == n.second_distance) n.best = firstAtRoot(others, own, n.best_distance);
  return n;
}

BothWays nearestBytes(const cv::Mat& mat_a, const cv::Mat& mat_b, const StopToken& stop) {
  const Table16 a = tableOf<uchar>(mat_a, 1.0);
  const Table16 b = tableOf<uchar>(mat_b, 1.0);
  BothWays result{std::vector<Neighbours>(a.rows), std::vector<Neighbours>(b.rows)};
  const auto addRow = [&](std::size_t i, const std::int32_t* row, NearestOfColumns& columns) {
    result.from_a[i] = neighboursOf(twoSmallest(row, b.rows), b, a.row(i));
    columns.add(static_cast<std::int32_t>(i), row);
  };
  const auto columns = reduceSquaredDistances<NearestOfColumns>(a, b, stop, addRow);
  for (std::size_t j = 0; j < b.rows; ++j) {
    stop.check();
    const TwoSmallest<std::int32_t> two{static_cast<std::size_t>(columns.best_at[j]), columns.best[j],
                                        columns.second[j]};
    result.from_b[j] = neighboursOf(two, a, b.row(j));
  }
  return result;
}

double largestNorm(const cv::Mat& matrix) {
  double largest = 0.0;
  for (int i = 0; i < matrix.rows; ++i) largest = std::max(largest, cv::norm(matrix.row(i), cv::NORM_L2));
  return largest;
}

// The square that no row can reach which is nearer than the second, given that each distance is known to
// `reach`.
std::int32_t boundAround(std::int32_t second, double reach) {
  const double farthest = std::sqrt(static_cast<double>(second)) + reach;
  return static_cast<std::int32_t>(std::min(farthest * farthest, 2147483647.0));
}

/// For each column the two nearest rows so far, by rounded squares, and by measured distances those of all
/// rows that may have been among them.
struct MeasuredColumns {
  std::vector<TwoSmallest<std::int32_t>> rounded;
  std::vector<std::int32_t> bounds;
  std::vector<TwoSmallest<float>> measured;
  explicit MeasuredColumns(std::size_t columns)
      : rounded(columns), bounds(columns, std::numeric_limits<std::int32_t>::max()), measured(columns) {}
  void append(const MeasuredColumns& behind) {
    for (std::size_t j = 0; j < measured.size(); ++j) measured[j].append(behind.measured[j]);
  }
};

// Whole numbers are far faster, so descriptors are first rounded to steps of 1 / scale. That moves each of
// them by at most √width / 2 steps and a distance by twice that, so it is known which rows may be among the
// two nearest. Only these are measured, as OpenCV does.
BothWays nearestFloats(const cv::Mat& mat_a, const cv::Mat& mat_b, const StopToken& stop) {
  constexpr double kLongest = 16000.0;  // steps: then |a|² + |b|² + 2 |a·b| stays below 2³¹
  const double scale = kLongest / std::max(1e-30, std::max(largestNorm(mat_a), largestNorm(mat_b)));
  const Table16 a = tableOf<float>(mat_a, scale);
  const Table16 b = tableOf<float>(mat_b, scale);
  const double reach =
      2.0 * std::sqrt(static_cast<double>(b.width)) + 1.0;  // 1: for rounding in OpenCV's own sum
  const auto distance = [&](std::size_t i, std::size_t j) {
    return std::sqrt(cv::hal::normL2Sqr_(mat_a.ptr<float>(static_cast<int>(i)),
                                         mat_b.ptr<float>(static_cast<int>(j)), mat_a.cols));
  };
  BothWays result{std::vector<Neighbours>(a.rows), std::vector<Neighbours>(b.rows)};
  const auto addRow = [&](std::size_t i, const std::int32_t* row, MeasuredColumns& columns) {
    const std::int32_t bound = boundAround(twoSmallest(row, b.rows).second, reach);
    TwoSmallest<float> two;
    for (std::size_t j = 0; j < b.rows; ++j) {
      const bool is_near_b = row[j] <= columns.bounds[j];
      if (row[j] > bound && !is_near_b) continue;
      const float measured = distance(i, j);
      if (row[j] <= bound) two.add(j, measured);
      if (!is_near_b) continue;
      columns.measured[j].add(i, measured);
      columns.rounded[j].add(i, row[j]);
      columns.bounds[j] = boundAround(columns.rounded[j].second, reach);
    }
    result.from_a[i] = {static_cast<int>(two.best_at), two.best, two.second};
  };
  const auto columns = reduceSquaredDistances<MeasuredColumns>(a, b, stop, addRow);
  for (std::size_t j = 0; j < b.rows; ++j) {
    const TwoSmallest<float>& two = columns.measured[j];
    result.from_b[j] = {static_cast<int>(two.best_at), two.best, two.second};
  }
  return result;
}

BothWays nearestBits(const cv::Mat& mat_a, const cv::Mat& mat_b, const StopToken& stop) {
  const auto a = wordsOf(mat_a);
  const auto b = wordsOf(mat_b);
  BothWays result{std::vector<Neighbours>(a.rows), std::vector<Neighbours>(b.rows)};
  const auto addRows = [&](std::size_t begin, std::size_t end, NearestOfColumns& columns) {
    std::vector<std::int32_t> bits(b.rows);
    for (std::size_t i = begin; i < end; ++i) {
      hammingRow(a.row(i), b.view(), bits.data());
      const auto two = twoSmallest(bits.data(), b.rows);
      result.from_a[i] = {static_cast<int>(two.best_at), static_cast<float>(two.best),
                          static_cast<float>(two.second)};
      columns.add(static_cast<std::int32_t>(i), bits.data());
    }
  };
  const auto columns = reduceRows(a.rows, NearestOfColumns(b.rows), stop, addRows);
  for (std::size_t j = 0; j < b.rows; ++j) {
    result.from_b[j] = {columns.best_at[j], static_cast<float>(columns.best[j]),
                        static_cast<float>(columns.second[j])};
  }
  return result;
}

std::vector<Neighbours> nearestByOpenCv(const cv::Mat& query, const cv::Mat& train, int norm,
                                        const StopToken& stop) {
  constexpr int kAtOnce = kQueriesPerTask;
  std::vector<Neighbours> result;
  if (train.rows < 2) return result;
  result.reserve(static_cast<std::size_t>(query.rows));
  for (int first = 0; first < query.rows; first += kAtOnce) {
    stop.check();
    std::vector<std::vector<cv::DMatch>> matches;
    const cv::Mat queries = query.rowRange(first, std::min(first + kAtOnce, query.rows));
    cv::BFMatcher(norm).knnMatch(queries, train, matches, 2);
    for (const auto& two : matches)
      result.push_back({two.at(0).trainIdx, two.at(0).distance, two.at(1).distance});
  }
  return result;
}

BothWays nearestByNorm(const cv::Mat& a, const cv::Mat& b, int norm, const StopToken& stop) {
  if (norm == cv::NORM_L2 && a.type() == CV_8U) return nearestBytes(a, b, stop);
  if (norm == cv::NORM_L2 && a.type() == CV_32F) return nearestFloats(a, b, stop);
  if (norm == cv::NORM_HAMMING && a.type() == CV_8U) return nearestBits(a, b, stop);
  // Any other norm or type, such as NORM_HAMMING2.
  return {nearestByOpenCv(a, b, norm, stop), nearestByOpenCv(b, a, norm, stop)};
}

}  // namespace

BothWays twoNearestBothWays(const cv::Mat& a, const cv::Mat& b, int norm, const StopToken& stop) {
  if (a.rows == 0 || b.rows == 0) return {};
  if (a.cols != b.cols || a.type() != b.type()) {
    throw std::invalid_argument("descriptors of different kinds cannot be matched");
  }
  BothWays result = nearestByNorm(a, b, norm, stop);
  if (b.rows < 2) result.from_a.clear();
  if (a.rows < 2) result.from_b.clear();
  return result;
}

}  // namespace sunlit::evaluate
