/// Distances of a few queries to all train descriptors: the inner loops of matching.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sunlit::evaluate {

/// Queries taken at once, so that a train row is loaded once for all of them.
constexpr int kQueriesAtOnce = 4;

/// A train set, or a set of queries: `rows` rows of `width` values.
template <typename Value>
struct RowsOf {
  const Value* data = nullptr;
  std::size_t rows = 0;
  std::size_t width = 0;
  const Value* row(std::size_t i) const { return data + i * width; }
};

/// out[q · train.rows + j] = Σ_k queries[q][k] · train[j][k]. Exact while every sum fits.
void dotRows(const std::int16_t* const queries[kQueriesAtOnce], const RowsOf<std::int16_t>& train,
             std::int32_t* out);
/// out[j] = number of bits in which `query` and train[j] differ. Width in words of 64 bit.
void hammingRow(const std::uint64_t* query, const RowsOf<std::uint64_t>& train, std::int32_t* out);

/// The two smallest values of each column of a matrix that is handed over row by row.
struct NearestOfColumns {
  std::vector<std::int32_t> best;  ///< the largest whole number where there is none, as `second`
  std::vector<std::int32_t> second;
  std::vector<std::int32_t> best_at;  ///< row; the first of equal ones
  explicit NearestOfColumns(std::size_t columns);
  /// Row `at`, which lies behind all others.
  void add(std::int32_t at, const std::int32_t* row);
  /// Rows that lie behind all of these.
  void append(const NearestOfColumns& behind);
};

}  // namespace sunlit::evaluate
