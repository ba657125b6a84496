#include "light/bake/samples/probe.h"

#include "sunlit/quantity/vector_clones.h"

namespace sunlit::light {

ReceiverGroup::ReceiverGroup(const Receiver* receivers, int count)
    : receivers_(receivers), count_(count), facings_() {
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3f &normal = receivers[i].normal, &face = receivers[i].face;
    facings_.normal_x[i] = normal.x(), facings_.normal_y[i] = normal.y(), facings_.normal_z[i] = normal.z();
    facings_.face_x[i] = face.x(), facings_.face_y[i] = face.y(), facings_.face_z[i] = face.z();
    facings_.transmission[i] = receivers[i].transmission;
  }
}

/// Sums in the order of Eigen, so that it is Receiver::weight() to the bit.
SUNLIT_WIDE_VECTOR_CLONES
void ReceiverGroup::weigh(const Facings& facings, const Eigen::Vector3f& towards, float* weights) {
  const Facings& f = facings;
  const float x = towards.x(), y = towards.y(), z = towards.z();
  for (int i = 0; i < RayPacket::kSize; ++i) {
    const float cosine = f.normal_x[i] * x + (f.normal_y[i] * y + f.normal_z[i] * z);
    const float above = f.face_x[i] * x + (f.face_y[i] * y + f.face_z[i] * z);
    const float before = (1.0f - f.transmission[i]) * cosine, behind = -f.transmission[i] * cosine;
    const float counted = cosine > 0.0f ? before : behind;
    weights[i] = above < 0.0f ? 0.0f : counted;
  }
}

}  // namespace sunlit::light
