/// A linked pair of shaders.
#pragma once

#include <string>

#include "render/gl_functions.h"

namespace sunlit::render {

class GlProgram {
 public:
  /// `definitions` (#define lines) go before both sources. Throws std::logic_error with the compiler's log.
  GlProgram(const std::string& definitions, const std::string& vertex_source,
            const std::string& fragment_source);
  ~GlProgram();
  GlProgram(const GlProgram&) = delete;
  GlProgram& operator=(const GlProgram&) = delete;

  void use() const { glUseProgram(program_); }
  /// −1, which GL ignores, where the program does not use it.
  GLint uniform(const char* name) const { return glGetUniformLocation(program_, name); }

 private:
  GLuint program_ = 0;
};

}  // namespace sunlit::render
