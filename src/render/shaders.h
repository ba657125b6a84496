/// The shaders that fill the geometry buffer.
#pragma once

namespace sunlit::render {

/// Camera-relative positions keep single precision good for millimetres far from the origin of `map`.
constexpr const char* kVertexShader = R"(
layout(location = 0) in vec3 position;  // map, m
layout(location = 1) in vec3 normal;    // map
layout(location = 2) in vec2 texture_coordinate;
layout(location = 3) in vec3 color;

uniform mat3 optical_from_map;
uniform vec3 eye_high;     // the camera in map, as the sum of two floats
uniform vec3 eye_low;
uniform vec4 projection;   // x and y scale, x and y shift, per unit of depth
uniform vec2 depth_range;  // near, far, m

out vec3 v_normal;
out vec2 v_texture_coordinate;
out vec3 v_color;

void main() {
  precise vec3 relative = (position - eye_high) - eye_low;
  vec3 optical = optical_from_map * relative;
  float near = depth_range.x;
  float far = depth_range.y;
  // Depth runs from 1 at the near to 0 at the far plane, where floating point numbers are densest.
  gl_Position = vec4(projection.xy * optical.xy + projection.zw * optical.z,
                     near * (far - optical.z) / (far - near), optical.z);
  v_normal = normal;
  v_texture_coordinate = texture_coordinate;
  v_color = color;
}
)";

/// Writes one packed sample; see packed_sample.h for the layout.
constexpr const char* kFragmentShader = R"(
in vec3 v_normal;
in vec2 v_texture_coordinate;
in vec3 v_color;

uniform sampler2D base_texture;
uniform vec3 base_color;
uniform float alpha_cutoff;
uniform uint first_triangle;  // of this draw, counted from 1

layout(location = 0) out uvec4 packed_sample;

uint packedAlbedo(vec3 albedo) {
  uvec3 code = uvec3(sqrt(clamp(albedo, 0.0, 1.0)) * 1023.0 + 0.5);
  return code.r | (code.g << 10) | (code.b << 20);
}

// Octahedral map: Cigolle et al., A Survey of Efficient Representations for Independent Unit Vectors, JCGT 3(2), 2014.
uint packedNormal(vec3 n) {
  float sum = abs(n.x) + abs(n.y) + abs(n.z);
  if (sum < 1e-6) return 0x80008000u;  // the file gave none
  vec2 p = n.xy / sum;
  if (n.z < 0.0) p = (1.0 - abs(p.yx)) * vec2(p.x >= 0.0 ? 1.0 : -1.0, p.y >= 0.0 ? 1.0 : -1.0);
  return packSnorm2x16(p);
}

void main() {
  vec3 albedo = base_color * v_color;
#ifdef TEXTURED
  vec4 texel = texture(base_texture, v_texture_coordinate);
#ifdef MASKED
  if (texel.a < alpha_cutoff) discard;
#endif
  albedo *= texel.rgb;
#endif
  packed_sample = uvec4(packedAlbedo(albedo), packedNormal(v_normal), first_triangle + uint(gl_PrimitiveID),
                        floatBitsToUint(1.0 / gl_FragCoord.w));
}
)";

}  // namespace sunlit::render
