/// Cosines of many arguments at once.
#pragma once

namespace sunlit::astronomy {

/// Replaces each of `count` values (rad, at most 1e7 in size) by its cosine. Within 2e-15 of std::cos. Plain
/// arithmetic that a compiler vectorises for any processor, so the bits do not depend on whether it does.
/// Several times as fast as std::cos.
void cosines(double* values, int count);

}  // namespace sunlit::astronomy
