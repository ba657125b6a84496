/// What the rasteriser asks of OpenGL, in its own language.
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

/// The rule of TileRaster: the size of the mask by the way between samples; the nearest texel in smaller
/// sizes, between four in the full one. `triangles` has four rows each: nearness, u / depth and v / depth
/// less those of the eye at a sample of its own, by column and by row, each row ended by the mask's place in
/// `masks`, u and v of the eye; then least and greatest nearness, and that sample.
inline constexpr char kMaskedShader[] = R"(#version 450 core
flat in uint triangle;
layout(location = 0) out uint seen;
uniform int first_masked;
uniform vec2 origin;  // column and row of the pass
uniform float texels_factor;
uniform samplerBuffer triangles;
uniform isamplerBuffer masks;  // MaskTable::rows
uniform usamplerBuffer alpha;

ivec2 texelOf(vec2 at, ivec2 size) { return min(ivec2(fract(at) * vec2(size)), size - 1); }

float alphaAt(ivec4 level, int x, int y) { return float(texelFetch(alpha, level.x + y * level.y + x).r); }

bool solidBetween(vec2 at, ivec4 level, float cutoff) {
  ivec2 size = level.yz;
  vec2 place = fract(at) * vec2(size) - 0.5;
  vec2 corner = floor(place), between = place - corner;
  ivec2 first = ivec2(corner);
  first.x = first.x < 0 ? size.x - 1 : min(first.x, size.x - 1);
  first.y = first.y < 0 ? size.y - 1 : min(first.y, size.y - 1);
  int right = first.x + 1 == size.x ? 0 : first.x + 1, below = first.y + 1 == size.y ? 0 : first.y + 1;
  float top_left = alphaAt(level, first.x, first.y), bottom_left = alphaAt(level, first.x, below);
  float top = top_left + between.x * (alphaAt(level, right, first.y) - top_left);
  float bottom = bottom_left + between.x * (alphaAt(level, right, below) - bottom_left);
  return top + between.y * (bottom - top) >= cutoff;
}

void main() {
  seen = triangle + 1u;
  int row = 4 * (int(triangle) - first_masked);
  vec4 w = texelFetch(triangles, row), u = texelFetch(triangles, row + 1), v = texelFetch(triangles, row + 2),
       more = texelFetch(triangles, row + 3);
  vec2 sample_at = floor(gl_FragCoord.xy) + origin - more.zw;
  float depth = 1.0 / clamp(w.x + w.y * sample_at.x + w.z * sample_at.y, more.x, more.y);
  vec2 at = depth * vec2(u.x + u.y * sample_at.x + u.z * sample_at.y, v.x + v.y * sample_at.x + v.z * sample_at.y);

  int mask = floatBitsToInt(w.w);
  ivec4 about = texelFetch(masks, mask), full = texelFetch(masks, mask + 1);
  vec2 factor = vec2(full.yz) * depth;
  vec2 right = factor * (vec2(u.y, v.y) - at * w.y), down = factor * (vec2(u.z, v.z) - at * w.z);
  float texels = texels_factor * max(dot(right, right), dot(down, down));
  int size = ((floatBitsToInt(texels) >> 23) - 127) >> 1;

  at += vec2(u.w, v.w);
  if (size <= 0) {
    if (!solidBetween(at, full, intBitsToFloat(about.z))) discard;
  } else {
    ivec4 level = texelFetch(masks, mask + 1 + min(size, about.x - 1));
    ivec2 texel = texelOf(at, level.yz);
    if (int(texelFetch(alpha, level.x + texel.y * level.y + texel.x).r) < about.y) discard;
  }
}
)";

}  // namespace sunlit::render::gl
