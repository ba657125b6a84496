/// An OpenGL 4.5 core context without a window. The only thing that a twin for another off-screen library
/// replaces.
#pragma once

#include <memory>

namespace sunlit::render {

class GlContext {
 public:
  /// Creates the context and makes it current on this thread. Throws std::runtime_error if there is none to
  /// be had.
  GlContext();
  ~GlContext();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  /// Every GL call goes to this context from now on. Throws std::logic_error on a thread that did not
  /// construct it.
  void makeCurrent();

  /// The GL function of this name, for those that the library has without exporting them. Throws
  /// std::runtime_error if there is none.
  using Function = void (*)();
  static Function function(const char* name);

 private:
  struct Handle;
  std::unique_ptr<Handle> handle_;
};

}  // namespace sunlit::render
