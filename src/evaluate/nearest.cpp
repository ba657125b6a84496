// twoNearest(): brute force, but only what decides is computed to the last bit.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/core/hal/hal.hpp>
#include <opencv2/features2d.hpp>
#include <stdexcept>

#include "evaluate/distance_rows.h"
#include "sunlit/evaluate/matching.h"

namespace sunlit::evaluate {
namespace {

constexpr std::size_t kLanes = 16;
constexpr std::size_t kQueriesPerTask = 64;

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
Table16 tableOf(const cv::Mat& matrix, double scale) {
  Table16 table;
  table.rows = static_cast<std::size_t>(matrix.rows);
  const auto columns = static_cast<std::size_t>(matrix.cols);
  table.width = (columns + kLanes - 1) / kLanes * kLanes;
  table.values.assign(table.rows * table.width, 0);
  for (std::size_t i = 0; i < table.rows; ++i) {
    const Source* source = matrix.ptr<Source>(static_cast<int>(i));
    std::int16_t* row = table.values.data() + i * table.width;
    for (std::size_t k = 0; k < columns; ++k)
      row[k] = static_cast<std::int16_t>(std::lround(source[k] * scale));
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
};

template <typename Value>
TwoSmallest<Value> twoSmallest(const Value* row, std::size_t size) {
  TwoSmallest<Value> two;
  for (std::size_t j = 0; j < size; ++j) two.add(j, row[j]);
  return two;
}

/// Calls body(first, last) for ranges of queries, in parallel.
template <typename Body>
void forQueries(std::size_t queries, const Body& body) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, queries, kQueriesPerTask),
                    [&](const tbb::blocked_range<std::size_t>& range) { body(range.begin(), range.end()); });
}

// Squared distances of all pairs, |a − b|² = |a|² + |b|² − 2 a·b, exact in whole numbers; body(i, row) for
// each query i.
template <typename Body>
void forSquaredDistances(const Table16& a, const Table16& b, const Body& body) {
  const std::vector<std::int32_t> norms_a = squaredNorms(a);
  const std::vector<std::int32_t> norms_b = squaredNorms(b);
  forQueries(a.rows, [&](std::size_t begin, std::size_t end) {
    std::vector<std::int32_t> squares(kQueriesAtOnce * b.rows);
    for (std::size_t first = begin; first < end; first += kQueriesAtOnce) {
      const std::int16_t* queries[kQueriesAtOnce];
      for (std::size_t q = 0; q < kQueriesAtOnce; ++q) queries[q] = a.row(std::min(first + q, end - 1));
      dotRows(queries, b.view(), squares.data());
      for (std::size_t i = first; i < std::min(first + kQueriesAtOnce, end); ++i) {
        std::int32_t* row = squares.data() + (i - first) * b.rows;
        for (std::size_t j = 0; j < b.rows; ++j) row[j] = norms_a[i] + norms_b[j] - 2 * row[j];
        body(i, row);
      }
    }
  });
}

std::vector<Neighbours> nearestBytes(const cv::Mat& query, const cv::Mat& train) {
  const Table16 a = tableOf<uchar>(query, 1.0);
  const Table16 b = tableOf<uchar>(train, 1.0);
  std::vector<Neighbours> result(a.rows);
  forSquaredDistances(a, b, [&](std::size_t i, const std::int32_t* row) {
    const auto two = twoSmallest(row, b.rows);
    const auto root = [](std::int32_t square) { return std::sqrt(static_cast<float>(square)); };
    Neighbours& n = result[i];
    n = {static_cast<int>(two.best_at), root(two.best), root(two.second)};
    // Different squares may have one rounded root; then the first of those rows counts.
    if (n.best_distance == n.second_distance) {
      n.best = static_cast<int>(
          std::find_if(row, row + b.rows, [&](std::int32_t d) { return root(d) == n.best_distance; }) - row);
    }
  });
  return result;
}

double largestNorm(const cv::Mat& matrix) {
  double largest = 0.0;
  for (int i = 0; i < matrix.rows; ++i) largest = std::max(largest, cv::norm(matrix.row(i), cv::NORM_L2));
  return largest;
}

// Whole numbers are far faster, so descriptors are first rounded to steps of 1 / scale. That moves each of
// them by at most √width / 2 steps and a distance by twice that, so it is known which rows may be among the
// two nearest. Only these are measured, as OpenCV does.
std::vector<Neighbours> nearestFloats(const cv::Mat& query, const cv::Mat& train) {
  constexpr double kLongest = 16000.0;  // steps: then |a|² + |b|² + 2 |a·b| stays below 2³¹
  const double scale = kLongest / std::max(1e-30, std::max(largestNorm(query), largestNorm(train)));
  const Table16 a = tableOf<float>(query, scale);
  const Table16 b = tableOf<float>(train, scale);
  const double reach =
      2.0 * std::sqrt(static_cast<double>(b.width)) + 1.0;  // 1: for rounding in OpenCV's own sum
  std::vector<Neighbours> result(a.rows);
  forSquaredDistances(a, b, [&](std::size_t i, const std::int32_t* row) {
    const double farthest = std::sqrt(static_cast<double>(twoSmallest(row, b.rows).second)) + reach;
    const auto bound = static_cast<std::int32_t>(std::min(farthest * farthest, 2147483647.0));
    TwoSmallest<float> two;
    for (std::size_t j = 0; j < b.rows; ++j) {
      if (row[j] > bound) continue;
      two.add(j, std::sqrt(cv::hal::normL2Sqr_(query.ptr<float>(static_cast<int>(i)),
                                               train.ptr<float>(static_cast<int>(j)), query.cols)));
    }
    result[i] = {static_cast<int>(two.best_at), two.best, two.second};
  });
  return result;
}

std::vector<Neighbours> nearestBits(const cv::Mat& query, const cv::Mat& train) {
  const auto a = wordsOf(query);
  const auto b = wordsOf(train);
  std::vector<Neighbours> result(a.rows);
  forQueries(a.rows, [&](std::size_t begin, std::size_t end) {
    std::vector<std::int32_t> bits(b.rows);
    for (std::size_t i = begin; i < end; ++i) {
      hammingRow(a.row(i), b.view(), bits.data());
      const auto two = twoSmallest(bits.data(), b.rows);
      result[i] = {static_cast<int>(two.best_at), static_cast<float>(two.best),
                   static_cast<float>(two.second)};
    }
  });
  return result;
}

// Any other norm or type, such as NORM_HAMMING2.
std::vector<Neighbours> nearestByOpenCv(const cv::Mat& query, const cv::Mat& train, int norm) {
  std::vector<std::vector<cv::DMatch>> matches;
  cv::BFMatcher(norm).knnMatch(query, train, matches, 2);
  std::vector<Neighbours> result;
  result.reserve(matches.size());
  for (const auto& two : matches)
    result.push_back({two.at(0).trainIdx, two.at(0).distance, two.at(1).distance});
  return result;
}

}  // namespace

std::vector<Neighbours> twoNearest(const cv::Mat& query, const cv::Mat& train, int norm) {
  if (train.rows < 2 || query.rows == 0) return {};
  if (query.cols != train.cols || query.type() != train.type()) {
    throw std::invalid_argument("descriptors of different kinds cannot be matched");
  }
  if (norm == cv::NORM_L2 && query.type() == CV_8U) return nearestBytes(query, train);
  if (norm == cv::NORM_L2 && query.type() == CV_32F) return nearestFloats(query, train);
  if (norm == cv::NORM_HAMMING && query.type() == CV_8U) return nearestBits(query, train);
  return nearestByOpenCv(query, train, norm);
}

}  // namespace sunlit::evaluate
