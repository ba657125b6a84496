#include "render/gl/function_table.h"

#include <stdexcept>
#include <string>

namespace sunlit::render::gl {

Functions::Functions(const Context& context) {
  const auto find = [&](auto* function, const char* name) {
    *function = reinterpret_cast<std::remove_pointer_t<decltype(function)>>(context.function(name));
    if (!*function) throw std::runtime_error("its OpenGL has no " + std::string(name));
  };
  find(&ActiveTexture, "glActiveTexture");
  find(&AttachShader, "glAttachShader");
  find(&BindBuffer, "glBindBuffer");
  find(&BindFramebuffer, "glBindFramebuffer");
  find(&BindRenderbuffer, "glBindRenderbuffer");
  find(&BindTexture, "glBindTexture");
  find(&BindVertexArray, "glBindVertexArray");
  find(&BufferData, "glBufferData");
  find(&CheckFramebufferStatus, "glCheckFramebufferStatus");
  find(&ClearBufferfv, "glClearBufferfv");
  find(&ClearBufferuiv, "glClearBufferuiv");
  find(&ClipControl, "glClipControl");
  find(&CompileShader, "glCompileShader");
  find(&CreateProgram, "glCreateProgram");
  find(&CreateShader, "glCreateShader");
  find(&DeleteBuffers, "glDeleteBuffers");
  find(&DeleteFramebuffers, "glDeleteFramebuffers");
  find(&DeleteProgram, "glDeleteProgram");
  find(&DeleteRenderbuffers, "glDeleteRenderbuffers");
  find(&DeleteShader, "glDeleteShader");
  find(&DeleteTextures, "glDeleteTextures");
  find(&DeleteVertexArrays, "glDeleteVertexArrays");
  find(&DepthFunc, "glDepthFunc");
  find(&DrawArrays, "glDrawArrays");
  find(&Enable, "glEnable");
  find(&EnableVertexAttribArray, "glEnableVertexAttribArray");
  find(&FramebufferRenderbuffer, "glFramebufferRenderbuffer");
  find(&GenBuffers, "glGenBuffers");
  find(&GenFramebuffers, "glGenFramebuffers");
  find(&GenRenderbuffers, "glGenRenderbuffers");
  find(&GenTextures, "glGenTextures");
  find(&GenVertexArrays, "glGenVertexArrays");
  find(&GetError, "glGetError");
  find(&GetIntegerv, "glGetIntegerv");
  find(&GetProgramInfoLog, "glGetProgramInfoLog");
  find(&GetProgramiv, "glGetProgramiv");
  find(&GetString, "glGetString");
  find(&GetUniformLocation, "glGetUniformLocation");
  find(&LinkProgram, "glLinkProgram");
  find(&PixelStorei, "glPixelStorei");
  find(&ReadPixels, "glReadPixels");
  find(&RenderbufferStorage, "glRenderbufferStorage");
  find(&Scissor, "glScissor");
  find(&ShaderSource, "glShaderSource");
  find(&TexBuffer, "glTexBuffer");
  find(&Uniform1f, "glUniform1f");
  find(&Uniform1i, "glUniform1i");
  find(&Uniform2f, "glUniform2f");
  find(&Uniform2i, "glUniform2i");
  find(&UseProgram, "glUseProgram");
  find(&VertexAttribIPointer, "glVertexAttribIPointer");
  find(&VertexAttribPointer, "glVertexAttribPointer");
  find(&Viewport, "glViewport");
}

}  // namespace sunlit::render::gl
