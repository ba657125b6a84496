#include "render/gl_program.h"

#include <array>
#include <stdexcept>

namespace sunlit::render {
namespace {

GLuint compile(GLenum kind, const std::string& definitions, const std::string& source) {
  const std::string header = "#version 450 core\n" + definitions;
  const std::array<const char*, 2> parts = {header.c_str(), source.c_str()};
  const GLuint shader = glCreateShader(kind);
  glShaderSource(shader, static_cast<GLsizei>(parts.size()), parts.data(), nullptr);
  glCompileShader(shader);
  GLint good = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (good == GL_TRUE) return shader;
  std::array<char, 4096> log{};
  glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
  glDeleteShader(shader);
  throw std::logic_error(std::string("shader: ") + log.data());
}

}  // namespace

GlProgram::GlProgram(const std::string& definitions, const std::string& vertex_source,
                     const std::string& fragment_source) {
  const GLuint vertex = compile(GL_VERTEX_SHADER, definitions, vertex_source);
  const GLuint fragment = compile(GL_FRAGMENT_SHADER, definitions, fragment_source);
  program_ = glCreateProgram();
  glAttachShader(program_, vertex);
  glAttachShader(program_, fragment);
  glLinkProgram(program_);
  glDeleteShader(vertex);
  glDeleteShader(fragment);
  GLint good = GL_FALSE;
  glGetProgramiv(program_, GL_LINK_STATUS, &good);
  if (good == GL_TRUE) return;
  std::array<char, 4096> log{};
  glGetProgramInfoLog(program_, static_cast<GLsizei>(log.size()), nullptr, log.data());
  glDeleteProgram(program_);
  throw std::logic_error(std::string("shader: ") + log.data());
}

GlProgram::~GlProgram() {
  glDeleteProgram(program_);
}

}  // namespace sunlit::render
