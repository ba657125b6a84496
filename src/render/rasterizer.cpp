#include "render/rasterizer.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include "render/builtin_rasterizer.h"
#if defined(SUNLIT_HAS_OSMESA) || defined(SUNLIT_HAS_EGL)
#include "render/gl/gl_rasterizer.h"
#endif

namespace sunlit::render {
namespace {

constexpr RasterizerKind kAll[] = {RasterizerKind::kOsmesa, RasterizerKind::kEgl, RasterizerKind::kBuiltin};

bool built(RasterizerKind kind) {
  switch (kind) {
#ifndef SUNLIT_HAS_OSMESA
    case RasterizerKind::kOsmesa:
      return false;
#endif
#ifndef SUNLIT_HAS_EGL
    case RasterizerKind::kEgl:
      return false;
#endif
    default:
      return true;
  }
}

#if defined(SUNLIT_HAS_OSMESA) || defined(SUNLIT_HAS_EGL)
std::shared_ptr<gl::Device> deviceOf(RasterizerKind kind) {
  return gl::Device::of(kind);
}

/// Why it cannot start; empty if it can.
std::string obstacle(RasterizerKind kind) {
  if (kind == RasterizerKind::kBuiltin) return {};
  if (!built(kind)) return "this build was made without it";
  try {
    deviceOf(kind);
    return {};
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}
#else
std::string obstacle(RasterizerKind kind) {
  return built(kind) ? "" : "this build was made without it";
}
#endif

/// Those that can start here, but for `without`.
std::string others(RasterizerKind without) {
  std::string names;
  for (const RasterizerKind other : kAll) {
    if (other == without || !obstacle(other).empty()) continue;
    names += (names.empty() ? "" : ", ") + nameOf(other);
  }
  return names;
}

}  // namespace

std::vector<RasterizerKind> builtRasterizers() {
  std::vector<RasterizerKind> kinds;
  std::copy_if(std::begin(kAll), std::end(kAll), std::back_inserter(kinds), built);
  return kinds;
}

RasterizerKind defaultRasterizer() {
  return builtRasterizers().front();
}

std::vector<std::string> rasterizerNames() {
  return {"osmesa", "egl", "builtin"};
}

std::string nameOf(RasterizerKind kind) {
  return rasterizerNames()[static_cast<std::size_t>(kind)];
}

void requireStarts(RasterizerKind kind) {
  const std::string why_not = obstacle(kind);
  if (!why_not.empty()) {
    throw std::runtime_error("rasterizer " + nameOf(kind) + " cannot start: " + why_not +
                             "; those that can: " + others(kind));
  }
}

std::unique_ptr<Rasterizer> makeRasterizer(RasterizerKind kind, const RasterizerWorld& world) {
  if (kind == RasterizerKind::kBuiltin) return std::make_unique<BuiltinRasterizer>(world);
  requireStarts(kind);
#if defined(SUNLIT_HAS_OSMESA) || defined(SUNLIT_HAS_EGL)
  return std::make_unique<gl::GlRasterizer>(deviceOf(kind), world);
#else
  return nullptr;  // not reached: an obstacle was found
#endif
}

}  // namespace sunlit::render
