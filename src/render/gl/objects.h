/// What a rasterizer holds in OpenGL.
#pragma once

#include <string>
#include <vector>

#include "render/gl/function_table.h"
#include "render/gl/mask_table.h"
#include "render/gl/triangle_list.h"

namespace sunlit::render::gl {

/// Throws std::runtime_error if OpenGL has met an error, such as the end of its memory.
void requireNoError(const Functions& gl);

class Program {
 public:
  using Text = std::vector<const char*>;  ///< in parts
  Program(const Functions& gl, const Text& corner_shader, const Text& sample_shader);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void use() const { gl_.UseProgram(number_); }
  GLint uniform(const char* name) const { return gl_.GetUniformLocation(number_, name); }

 private:
  void attach(GLenum stage, const Text& parts) const;

  const Functions& gl_;
  GLuint number_;
};

/// A buffer, and the texture by which shaders look it up.
class TextureBuffer {
 public:
  TextureBuffer(const Functions& gl, GLenum format);
  ~TextureBuffer();
  TextureBuffer(const TextureBuffer&) = delete;
  TextureBuffer& operator=(const TextureBuffer&) = delete;

  void fill(const void* data, std::size_t bytes) const;
  void bind(GLuint unit) const;

 private:
  const Functions& gl_;
  GLuint buffer_ = 0, texture_ = 0;
};

/// To be made, used and destroyed on the device's thread.
class Objects {
 public:
  /// Throws std::runtime_error if the masks are more than the device can look up.
  Objects(const Functions& gl, const MaskTable& masks);
  ~Objects();
  Objects(const Objects&) = delete;
  Objects& operator=(const Objects&) = delete;

  const Program& program(TriangleList::Batch batch) const;
  void upload(const TriangleList& triangles) const;
  /// Sets all state that drawing into a picture of this size, in samples, depends on but the viewport.
  void bind(int width, int height);

 private:
  const Functions& gl_;
  const Program opaque_, full_size_, any_size_, one_smaller_size_;
  const TextureBuffer triangles_, mask_rows_, alpha_;
  GLuint vertex_array_ = 0, corners_ = 0;
  GLuint framebuffer_ = 0, seen_ = 0, depth_ = 0;
  int width_ = 0, height_ = 0;  ///< of the framebuffer
};

}  // namespace sunlit::render::gl
