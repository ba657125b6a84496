#include "render/gl/gl_rasterizer.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "render/gl/objects.h"

namespace sunlit::render::gl {
namespace {

/// Samples a side of a pass: what a picture at four samples a pixel needs at most, as a rule. Larger pictures
/// are drawn in several, so that the device holds 128 MB and not gigabytes.
constexpr int kLargestPass = 4096;

/// A power of two, so that no coordinate is rounded; wide enough for corners beyond a pass, about whose
/// viewport there is a band, too, where drivers need not cut triangles.
int viewportSide(int width, int height) {
  int side = 256;
  while (2 * side < 5 * std::max(width, height)) side *= 2;
  return side;
}

}  // namespace

GlRasterizer::GlRasterizer(std::shared_ptr<Device> device, const RasterizerWorld& world)
    : device_(std::move(device)),
      visible_(world.geometry, world.pyramids),
      masks_(*world.geometry->scene, world.pyramids),
      texels_factor_(static_cast<float>(std::exp2(2.0 * world.lod_bias))),
      list_(masks_, texels_factor_) {
  device_->run([this](const Functions& gl) { objects_ = std::make_unique<Objects>(gl, masks_); });
  // The device has them. By move: an empty list would keep their memory.
  masks_.alpha = std::vector<std::uint8_t>();
  masks_.rows = std::vector<std::int32_t>();
}

GlRasterizer::~GlRasterizer() {
  const bool done = device_->run([this](const Functions&) { objects_ = nullptr; });
  if (!done) static_cast<void>(objects_.release());  // gone with the device
}

void GlRasterizer::draw(const View& view, const light::Geometry* bodies, std::vector<Sample>* samples) {
  const int width = view.camera.width * view.supersampling, height = view.camera.height * view.supersampling;
  samples->resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  visible_.gather(view, bodies);
  visible_.project(view, [](std::size_t) {});
  const auto near_m = static_cast<float>(view.near_m);
  list_.assemble(visible_, near_m);
  for (int top = 0; top < height; top += kLargestPass) {
    for (int left = 0; left < width; left += kLargestPass) {
      const Pass pass{left, top, std::min(kLargestPass, width - left), std::min(kLargestPass, height - top)};
      seen_.resize(static_cast<std::size_t>(pass.width) * static_cast<std::size_t>(pass.height));
      device_->run([&](const Functions& gl) {
        if (left == 0 && top == 0) objects_->upload(list_);
        drawPass(gl, pass, near_m / static_cast<float>(view.far_m));
        gl.ReadPixels(0, 0, pass.width, pass.height, GL_RED_INTEGER, GL_UNSIGNED_INT, seen_.data());
        requireNoError(gl);
      });
      write(pass, view, samples->data());
    }
  }
}

void GlRasterizer::drawPass(const Functions& gl, const Pass& pass, float farthest) const {
  objects_->bind(pass.width, pass.height);
  const int side = viewportSide(pass.width, pass.height);
  const int middle_x = pass.width / 2, middle_y = pass.height / 2;
  gl.Viewport(middle_x - side / 2, middle_y - side / 2, side, side);
  gl.Scissor(0, 0, pass.width, pass.height);
  constexpr GLuint kNothing[4] = {0, 0, 0, 0};
  gl.ClearBufferuiv(GL_COLOR, 0, kNothing);
  gl.ClearBufferfv(GL_DEPTH, 0, &farthest);
  for (const auto batch : {TriangleList::kOpaque, TriangleList::kFullSize, TriangleList::kAnySize,
                           TriangleList::kOneSmallerSize}) {
    const Program& program = objects_->program(batch);
    program.use();
    // Sample (0, 0) of the pass is the pixel whose middle lies half a sample from its corner.
    constexpr int kSteps = ScreenTriangle::kSteps;
    gl.Uniform2i(program.uniform("middle"), kSteps * (pass.left + middle_x) - kSteps / 2,
                 kSteps * (pass.top + middle_y) - kSteps / 2);
    gl.Uniform1f(program.uniform("viewport_per_step"), 2.0f / static_cast<float>(kSteps * side));
    // An opaque one has none of these, which OpenGL passes over.
    gl.Uniform1i(program.uniform("first_masked"), static_cast<GLint>(list_.count(TriangleList::kOpaque)));
    gl.Uniform2f(program.uniform("origin"), static_cast<float>(pass.left), static_cast<float>(pass.top));
    gl.Uniform1f(program.uniform("texels_factor"), texels_factor_);
    gl.DrawArrays(GL_TRIANGLES, static_cast<GLint>(3 * list_.first(batch)),
                  static_cast<GLsizei>(3 * list_.count(batch)));
  }
}

void GlRasterizer::write(const Pass& pass, const View& view, Sample* samples) const {
  const auto stride = static_cast<std::size_t>(view.camera.width * view.supersampling);
  const float sky_depth = 1.0f / (1.0f / static_cast<float>(view.far_m));
  tbb::parallel_for(0, pass.height, [&](int row) {
    const std::uint32_t* const seen =
        &seen_[static_cast<std::size_t>(row) * static_cast<std::size_t>(pass.width)];
    Sample* const out = samples + static_cast<std::size_t>(pass.top + row) * stride + pass.left;
    for (int from = 0, to = 0; from < pass.width; from = to) {
      while (to < pass.width && seen[to] == seen[from]) ++to;
      if (seen[from] == 0) {
        std::fill(out + from, out + to, Sample{0, sky_depth});
        continue;
      }
      // The plane is sharper than what the device interpolates.
      const ScreenTriangle& triangle = list_[seen[from] - 1];
      const auto first = static_cast<float>(triangle.nearness(pass.left + from, pass.top + row));
      const auto step = static_cast<float>(triangle.nearness.per_column);
      for (int i = from; i < to; ++i) {
        const float here = first + step * static_cast<float>(i - from);
        out[i] = {triangle.number,
                  1.0f / std::clamp(here, triangle.nearness_least, triangle.nearness_greatest)};
      }
    }
  });
}

}  // namespace sunlit::render::gl
