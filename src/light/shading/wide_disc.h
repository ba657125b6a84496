/// Where a light is so wide beside a mirror's lobe that its shape shows.
#pragma once

namespace sunlit::light {

/// Half the width, by the sines of their angles, of the facets that mirror a round source's points at `v_h`,
/// the cosine between the eye and the facet amid them.
inline float widthOfFacets(float radius_rad, float v_h) {
  return 0.5f * radius_rad / v_h;
}

/// Whether a lobe of that roughness shows the facets of a source as the ellipse that they are. What is wider
/// than a small disc in the sky, such as a lamp close by, has no ellipse of facets.
inline bool showsEllipse(float roughness, float v_h, float radius_rad) {
  constexpr float kWide = 0.3f, kDisc_rad = 0.05f;
  return radius_rad < kDisc_rad && widthOfFacets(radius_rad, v_h) > kWide * roughness * roughness;
}

}  // namespace sunlit::light
