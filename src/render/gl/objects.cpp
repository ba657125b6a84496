#include "render/gl/objects.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <stdexcept>

#include "render/gl/shaders.h"

namespace sunlit::render::gl {

void requireNoError(const Functions& gl) {
  const GLenum error = gl.GetError();
  if (error == GL_NO_ERROR) return;
  while (gl.GetError() != GL_NO_ERROR) continue;
  throw std::runtime_error(error == GL_OUT_OF_MEMORY ? "OpenGL is out of memory"
                                                     : "OpenGL reports error " + std::to_string(error));
}

Program::Program(const Functions& gl, const Text& corner_shader, const Text& sample_shader)
    : gl_(gl), number_(gl.CreateProgram()) {
  attach(GL_VERTEX_SHADER, corner_shader);
  attach(GL_FRAGMENT_SHADER, sample_shader);
  gl_.LinkProgram(number_);
  GLint good = 0;
  gl_.GetProgramiv(number_, GL_LINK_STATUS, &good);
  if (good) return;
  std::array<char, 1000> why{};
  gl_.GetProgramInfoLog(number_, static_cast<GLsizei>(why.size()), nullptr, why.data());
  gl_.DeleteProgram(number_);
  throw std::runtime_error("its OpenGL does not take our shaders: " + std::string(why.data()));
}

Program::~Program() {
  gl_.DeleteProgram(number_);
}

void Program::attach(GLenum stage, const Text& parts) const {
  const GLuint shader = gl_.CreateShader(stage);
  gl_.ShaderSource(shader, static_cast<GLsizei>(parts.size()), parts.data(), nullptr);
  gl_.CompileShader(shader);
  gl_.AttachShader(number_, shader);
  gl_.DeleteShader(shader);  // lives as long as the program
}

TextureBuffer::TextureBuffer(const Functions& gl, GLenum format) : gl_(gl) {
  gl_.GenBuffers(1, &buffer_);
  gl_.GenTextures(1, &texture_);
  gl_.BindBuffer(GL_TEXTURE_BUFFER, buffer_);
  gl_.BindTexture(GL_TEXTURE_BUFFER, texture_);
  gl_.TexBuffer(GL_TEXTURE_BUFFER, format, buffer_);
}

TextureBuffer::~TextureBuffer() {
  gl_.DeleteTextures(1, &texture_);
  gl_.DeleteBuffers(1, &buffer_);
}

void TextureBuffer::fill(const void* data, std::size_t bytes) const {
  gl_.BindBuffer(GL_TEXTURE_BUFFER, buffer_);
  gl_.BufferData(GL_TEXTURE_BUFFER, static_cast<GLsizeiptr>(bytes), data, GL_STREAM_DRAW);
}

void TextureBuffer::bind(GLuint unit) const {
  gl_.ActiveTexture(GL_TEXTURE0 + unit);
  gl_.BindTexture(GL_TEXTURE_BUFFER, texture_);
}

Objects::Objects(const Functions& gl, const MaskTable& masks)
    : gl_(gl),
      opaque_(gl, {kCornerShader}, {kOpaqueShader}),
      full_size_(gl, {kFullSize, kMaskedCornerShader}, {kFullSize, kMaskedShader}),
      any_size_(gl, {kAnySize, kMaskedCornerShader}, {kAnySize, kMaskedShader}),
      one_smaller_size_(gl, {kOneSmallerSize, kMaskedCornerShader}, {kOneSmallerSize, kMaskedShader}),
      triangles_(gl, GL_RGBA32F),
      mask_rows_(gl, GL_RGBA32I),
      alpha_(gl, GL_R8UI) {
  GLint most = 0;
  gl_.GetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &most);
  if (masks.alpha.size() > static_cast<std::size_t>(most)) {
    throw std::runtime_error("the scene's cut-outs have " + std::to_string(masks.alpha.size()) +
                             " texels in all sizes, of which OpenGL takes " + std::to_string(most) +
                             " here; the rasterizer builtin has no such limit");
  }
  mask_rows_.fill(masks.rows.data(), masks.rows.size() * sizeof(masks.rows[0]));
  alpha_.fill(masks.alpha.data(), masks.alpha.size());
  for (const Program* masked : {&full_size_, &any_size_, &one_smaller_size_}) {
    masked->use();
    gl_.Uniform1i(masked->uniform("triangles"), 0);
    gl_.Uniform1i(masked->uniform("masks"), 1);
    gl_.Uniform1i(masked->uniform("alpha"), 2);
  }

  gl_.GenVertexArrays(1, &vertex_array_);
  gl_.GenBuffers(1, &corners_);
  gl_.BindVertexArray(vertex_array_);
  gl_.BindBuffer(GL_ARRAY_BUFFER, corners_);
  constexpr GLsizei kStride = sizeof(TriangleList::Corner);
  gl_.EnableVertexAttribArray(0);
  gl_.VertexAttribIPointer(0, 2, GL_INT, kStride, nullptr);
  gl_.EnableVertexAttribArray(1);
  gl_.VertexAttribPointer(1, 1, GL_FLOAT, GL_FALSE, kStride,
                          reinterpret_cast<const void*>(offsetof(TriangleList::Corner, depth)));

  gl_.GenFramebuffers(1, &framebuffer_);
  gl_.GenRenderbuffers(1, &seen_);
  gl_.GenRenderbuffers(1, &depth_);
  requireNoError(gl_);
}

Objects::~Objects() {
  gl_.DeleteFramebuffers(1, &framebuffer_);
  gl_.DeleteRenderbuffers(1, &seen_);
  gl_.DeleteRenderbuffers(1, &depth_);
  gl_.DeleteVertexArrays(1, &vertex_array_);
  gl_.DeleteBuffers(1, &corners_);
}

const Program& Objects::program(TriangleList::Batch batch) const {
  switch (batch) {
    case TriangleList::kFullSize:
      return full_size_;
    case TriangleList::kAnySize:
      return any_size_;
    case TriangleList::kOneSmallerSize:
      return one_smaller_size_;
    default:
      return opaque_;
  }
}

void Objects::upload(const TriangleList& triangles) const {
  gl_.BindBuffer(GL_ARRAY_BUFFER, corners_);
  const auto& corners = triangles.corners();
  gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(corners.size() * sizeof(corners[0])),
                 corners.data(), GL_STREAM_DRAW);
  triangles_.fill(triangles.masked().data(), triangles.masked().size() * sizeof(TriangleList::Masked));
}

void Objects::bind(int width, int height) {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  if (width > width_ || height > height_) {
    width_ = std::max(width, width_);
    height_ = std::max(height, height_);
    gl_.BindRenderbuffer(GL_RENDERBUFFER, seen_);
    gl_.RenderbufferStorage(GL_RENDERBUFFER, GL_R32UI, width_, height_);
    gl_.BindRenderbuffer(GL_RENDERBUFFER, depth_);
    gl_.RenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, width_, height_);
    gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, seen_);
    gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_);
    requireNoError(gl_);
    if (gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
      throw std::runtime_error("OpenGL cannot draw whole numbers with depth in single precision");
  }
  // Depth as it comes, nearer is greater. Row 0 is the picture's uppermost, so that samples on an edge belong
  // to the same triangle as by our own rule.
  gl_.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  gl_.Enable(GL_DEPTH_CLAMP);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthFunc(GL_GREATER);
  gl_.Enable(GL_SCISSOR_TEST);
  gl_.PixelStorei(GL_PACK_ALIGNMENT, 4);
  gl_.BindVertexArray(vertex_array_);
  triangles_.bind(0);
  mask_rows_.bind(1);
  alpha_.bind(2);
}

}  // namespace sunlit::render::gl
