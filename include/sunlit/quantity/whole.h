/// Whole numbers of real ones.
#pragma once

namespace sunlit {

/// ⌊value⌋ of a float or double within the range of int. std::floor is a function call without newer
/// instructions than every x86-64 has, and that would be a third of what looking up a texel takes; inlined
/// always, so that code built for several processors stays one piece.
template <typename Real>
inline __attribute__((always_inline)) int floorOf(Real value) {
  const int truncated = static_cast<int>(value);
  return truncated - (value < static_cast<Real>(truncated) ? 1 : 0);
}

}  // namespace sunlit
