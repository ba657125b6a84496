#include "evaluate/features/distance_rows.h"

#include <algorithm>
#include <limits>

#include "sunlit/quantity/vector_clones.h"

// As SUNLIT_VECTOR_CLONES, for the instruction that counts bits.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__) && !defined(SUNLIT_PLAIN_LOOPS)
#define SUNLIT_POPCOUNT_CLONES __attribute__((target_clones("popcnt", "default")))
#else
#define SUNLIT_POPCOUNT_CLONES
#endif

namespace sunlit::evaluate {
SUNLIT_VECTOR_CLONES
void dotRows(const std::int16_t* const queries[kQueriesAtOnce], const RowsOf<std::int16_t>& train,
             std::int32_t* out) {
  const std::int16_t* q0 = queries[0];
  const std::int16_t* q1 = queries[1];
  const std::int16_t* q2 = queries[2];
  const std::int16_t* q3 = queries[3];
  for (std::size_t j = 0; j < train.rows; ++j) {
    const std::int16_t* t = train.row(j);
    std::int32_t s0 = 0;
    std::int32_t s1 = 0;
    std::int32_t s2 = 0;
    std::int32_t s3 = 0;
    for (std::size_t k = 0; k < train.width; ++k) {
      s0 += q0[k] * t[k];
      s1 += q1[k] * t[k];
      s2 += q2[k] * t[k];
      s3 += q3[k] * t[k];
    }
    out[j] = s0;
    out[train.rows + j] = s1;
    out[2 * train.rows + j] = s2;
    out[3 * train.rows + j] = s3;
  }
}

namespace {

// A width that the compiler knows lets it unroll the loop. Inlined by force, or it would not be compiled with
// its caller's instruction set.
template <std::size_t kWidth>
[[gnu::always_inline]] inline void hammingRowOf(const std::uint64_t* query,
                                                const RowsOf<std::uint64_t>& train, std::int32_t* out) {
  for (std::size_t j = 0; j < train.rows; ++j) {
    const std::uint64_t* t = train.data + j * kWidth;
    int bits = 0;
    for (std::size_t k = 0; k < kWidth; ++k) bits += __builtin_popcountll(query[k] ^ t[k]);
    out[j] = bits;
  }
}

constexpr std::size_t kOrbWords = 4;
constexpr std::size_t kBriskWords = 8;

}  // namespace

SUNLIT_POPCOUNT_CLONES
void hammingRow(const std::uint64_t* query, const RowsOf<std::uint64_t>& train, std::int32_t* out) {
  if (train.width == kBriskWords) return hammingRowOf<kBriskWords>(query, train, out);
  if (train.width == kOrbWords) return hammingRowOf<kOrbWords>(query, train, out);
  for (std::size_t j = 0; j < train.rows; ++j) {
    const std::uint64_t* t = train.row(j);
    int bits = 0;
    for (std::size_t k = 0; k < train.width; ++k) bits += __builtin_popcountll(query[k] ^ t[k]);
    out[j] = bits;
  }
}

namespace {

// Plain pointers that do not overlap, and no branch: the compiler makes it a few instructions for eight
// columns.
SUNLIT_VECTOR_CLONES
void addToColumns(std::int32_t at, const std::int32_t* __restrict row, std::size_t columns,
                  std::int32_t* __restrict best, std::int32_t* __restrict second,
                  std::int32_t* __restrict best_at) {
  for (std::size_t j = 0; j < columns; ++j) {
    const std::int32_t value = row[j];
    const std::int32_t old = best[j];
    second[j] = std::min(second[j], std::max(old, value));
    best_at[j] = value < old ? at : best_at[j];
    best[j] = std::min(old, value);
  }
}

}  // namespace

NearestOfColumns::NearestOfColumns(std::size_t columns)
    : best(columns, std::numeric_limits<std::int32_t>::max()), second(best), best_at(columns, 0) {}

void NearestOfColumns::add(std::int32_t at, const std::int32_t* row) {
  addToColumns(at, row, best.size(), best.data(), second.data(), best_at.data());
}

void NearestOfColumns::append(const NearestOfColumns& behind) {
  for (std::size_t j = 0; j < best.size(); ++j) {
    if (behind.best[j] < best[j]) best_at[j] = behind.best_at[j];
    second[j] = std::min({std::max(best[j], behind.best[j]), second[j], behind.second[j]});
    best[j] = std::min(best[j], behind.best[j]);
  }
}

}  // namespace sunlit::evaluate
