/// What the rasterizer asks of OpenGL, in its own language.
#pragma once

namespace sunlit::render::gl {

/// Corners come in steps, see ScreenTriangle, and go to the viewport, of which `middle` is the centre: all
/// whole numbers times powers of two, so that no processor rounds them. Depth is nearness times the nearest
/// depth, linear on the screen as it stands.
inline constexpr char kCornerShader[] = R"(#version 450 core
layout(location = 0) in ivec2 corner;
layout(location = 1) in float nearness;
uniform ivec2 middle;
uniform float viewport_per_step;
flat out uint triangle;
void main() {
  triangle = uint(gl_VertexID) / 3u;
  gl_Position = vec4(vec2(corner - middle) * viewport_per_step, nearness, 1.0);
}
)";

inline constexpr char kOpaqueShader[] = R"(#version 450 core
flat in uint triangle;
layout(location = 0) out uint seen;
void main() { seen = triangle + 1u; }
)";

/// The sizes of its mask that a triangle's samples look up: shaders with less to choose from are faster.
inline constexpr char kFullSize[] = "#version 450 core\n#define FULL_SIZE\n";
inline constexpr char kOneSmallerSize[] = "#version 450 core\n#define ONE_SMALLER_SIZE\n";
inline constexpr char kAnySize[] = "#version 450 core\n#define ANY_SIZE\n";

/// To be put after one of the above, as the next. What belongs to a triangle is looked up here, thrice, and
/// not for each of its samples. `triangles` has four rows each: nearness, u / depth and v / depth less those
/// of the eye at a sample of its own, by column and by row, each row ended by the place of the size, or of
/// the mask for kAnySize, in `masks`, u and v of the eye; then least and greatest nearness, and that sample.
inline constexpr char kMaskedCornerShader[] = R"(
layout(location = 0) in ivec2 corner;
layout(location = 1) in float nearness;
uniform ivec2 middle;
uniform float viewport_per_step;
uniform int first_masked;
uniform samplerBuffer triangles;
uniform isamplerBuffer masks;  // MaskTable::rows
flat out uint triangle;
flat out vec3 w;
flat out vec4 u, v, more;
flat out int place;  // in `masks`
flat out ivec4 mask;
void main() {
  triangle = uint(gl_VertexID) / 3u;
  int row = 4 * (int(triangle) - first_masked);
  vec4 first = texelFetch(triangles, row);
  w = first.xyz;
  u = texelFetch(triangles, row + 1);
  v = texelFetch(triangles, row + 2);
  more = texelFetch(triangles, row + 3);
  place = floatBitsToInt(first.w);
  mask = texelFetch(masks, place);
  gl_Position = vec4(vec2(corner - middle) * viewport_per_step, nearness, 1.0);
}
)";

/// The rule of TileRaster: the size of the mask by the way between samples; the nearest texel in smaller
/// sizes, between four in the full one.
inline constexpr char kMaskedShader[] = R"(
flat in uint triangle;
flat in vec3 w;
flat in vec4 u, v, more;
flat in int place;
flat in ivec4 mask;
layout(location = 0) out uint seen;
uniform vec2 origin;  // column and row of the pass
uniform float texels_factor;
uniform isamplerBuffer masks;
uniform usamplerBuffer alpha;

float alphaAt(ivec4 size, int x, int y) { return float(texelFetch(alpha, size.x + y * size.y + x).r); }

bool solidBetween(vec2 at, ivec4 mask) {
  ivec2 size = mask.yz;
  vec2 place = fract(at) * vec2(size) - 0.5;
  vec2 corner = floor(place), between = place - corner;
  ivec2 first = ivec2(corner);
  first.x = first.x < 0 ? size.x - 1 : min(first.x, size.x - 1);
  first.y = first.y < 0 ? size.y - 1 : min(first.y, size.y - 1);
  int right = first.x + 1 == size.x ? 0 : first.x + 1, below = first.y + 1 == size.y ? 0 : first.y + 1;
  float top_left = alphaAt(mask, first.x, first.y), bottom_left = alphaAt(mask, first.x, below);
  float top = top_left + between.x * (alphaAt(mask, right, first.y) - top_left);
  float bottom = bottom_left + between.x * (alphaAt(mask, right, below) - bottom_left);
  return top + between.y * (bottom - top) >= intBitsToFloat(mask.w);
}

bool solidTexel(vec2 at, ivec4 mask) {
  ivec2 texel = min(ivec2(fract(at) * vec2(mask.yz)), mask.yz - 1);
  return int(texelFetch(alpha, mask.x + texel.y * mask.y + texel.x).r) >= mask.w;
}

void main() {
  seen = triangle + 1u;
  vec2 sample_at = floor(gl_FragCoord.xy) + origin - more.zw;
  float depth = 1.0 / clamp(w.x + w.y * sample_at.x + w.z * sample_at.y, more.x, more.y);
  vec2 at = depth * vec2(u.x + u.y * sample_at.x + u.z * sample_at.y, v.x + v.y * sample_at.x + v.z * sample_at.y);
  vec2 from_eye = at + vec2(u.w, v.w);
#ifdef FULL_SIZE
  if (!solidBetween(from_eye, mask)) discard;
#endif
#ifdef ONE_SMALLER_SIZE
  if (!solidTexel(from_eye, mask)) discard;
#endif
#ifdef ANY_SIZE
  ivec4 full = texelFetch(masks, place + 1);
  vec2 factor = vec2(full.yz) * depth;
  vec2 right = factor * (vec2(u.y, v.y) - at * w.y), down = factor * (vec2(u.z, v.z) - at * w.z);
  float texels = texels_factor * max(dot(right, right), dot(down, down));
  int size = ((floatBitsToInt(texels) >> 23) - 127) >> 1;
  if (size <= 0) {
    if (!solidBetween(from_eye, full)) discard;
  } else {
    if (!solidTexel(from_eye, texelFetch(masks, place + 1 + min(size, mask.x - 1)))) discard;
  }
#endif
}
)";

}  // namespace sunlit::render::gl
