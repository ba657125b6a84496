/// OpenGL without a window: where its contexts come from.
#pragma once

#include <memory>

namespace sunlit::render::gl {

/// A context of OpenGL 4.5, core profile, current in the thread that made it until that thread destroys it.
class Context {
 public:
  virtual ~Context() = default;
  using Function = void (*)();
  /// Of OpenGL, by its full name; null if this one has none.
  virtual Function function(const char* name) const = 0;
};

/// Both throw std::runtime_error saying why not.
std::unique_ptr<Context> makeOsmesaContext();
std::unique_ptr<Context> makeEglContext();

}  // namespace sunlit::render::gl
