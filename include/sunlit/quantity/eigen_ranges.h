/// Eigen's vectors in loops over ranges: `for (float channel : vector)`. Eigen has this from 3.4 on.
#pragma once

#include <Eigen/Core>

#if !EIGEN_VERSION_AT_LEAST(3, 4, 0)
namespace Eigen {

template <typename Vector>
const typename Vector::Scalar* begin(const PlainObjectBase<Vector>& vector) {
  static_assert(Vector::IsVectorAtCompileTime, "only vectors are ranges");
  return vector.data();
}

template <typename Vector>
const typename Vector::Scalar* end(const PlainObjectBase<Vector>& vector) {
  return vector.data() + vector.size();
}

}  // namespace Eigen
#endif
