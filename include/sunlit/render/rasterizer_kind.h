/// What people choose between to find which triangle each sample of a picture sees.
#pragma once

#include <string>
#include <vector>

namespace sunlit::render {

/// All make the same buffer, but for a few samples in ten thousand: on edges within rounding, and between
/// surfaces that lie in each other.
enum class RasterizerKind {
  kOsmesa,  ///< OpenGL in software, without a screen: Mesa's OSMesa
  kEgl,     ///< OpenGL by EGL, without a screen: on a GPU where there is one, else in software
  kBuiltin  ///< our own, which needs no library
};

/// All that this build contains, the best first.
std::vector<RasterizerKind> builtRasterizers();
/// The first of builtRasterizers(): OSMesa, unless it was left out.
RasterizerKind defaultRasterizer();

/// osmesa, egl, builtin: what people type, in the order of the enumerators.
std::vector<std::string> rasterizerNames();
std::string nameOf(RasterizerKind kind);

/// Throws std::runtime_error if it is not built in or cannot start here, saying why and which others can.
void requireStarts(RasterizerKind kind);

}  // namespace sunlit::render
