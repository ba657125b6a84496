#include "render/rasteriser.h"

#include <algorithm>
#include <stdexcept>

#include "render/builtin_rasteriser.h"
#if defined(SUNLIT_HAS_OSMESA) || defined(SUNLIT_HAS_EGL)
#include "render/gl/gl_rasteriser.h"
#endif

namespace sunlit::render {
namespace {

constexpr Rasterizer kAll[] = {Rasterizer::kOsmesa, Rasterizer::kEgl, Rasterizer::kBuiltin};

bool built(Rasterizer rasterizer) {
  switch (rasterizer) {
#ifndef SUNLIT_HAS_OSMESA
    case Rasterizer::kOsmesa:
      return false;
#endif
#ifndef SUNLIT_HAS_EGL
    case Rasterizer::kEgl:
      return false;
#endif
    default:
      return true;
  }
}

#if defined(SUNLIT_HAS_OSMESA) || defined(SUNLIT_HAS_EGL)
std::shared_ptr<gl::Device> deviceOf(Rasterizer rasterizer) {
  return gl::Device::of(rasterizer);
}

/// Why it cannot start; empty if it can.
std::string obstacle(Rasterizer rasterizer) {
  if (rasterizer == Rasterizer::kBuiltin) return {};
  if (!built(rasterizer)) return "this build was made without it";
  try {
    deviceOf(rasterizer);
    return {};
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}
#else
std::string obstacle(Rasterizer rasterizer) {
  return built(rasterizer) ? "" : "this build was made without it";
}
#endif

/// Those that can start here, but for `without`.
std::string others(Rasterizer without) {
  std::string names;
  for (const Rasterizer other : kAll) {
    if (other == without || !obstacle(other).empty()) continue;
    names += (names.empty() ? "" : ", ") + nameOf(other);
  }
  return names;
}

}  // namespace

std::vector<Rasterizer> builtRasterizers() {
  std::vector<Rasterizer> rasterizers;
  std::copy_if(std::begin(kAll), std::end(kAll), std::back_inserter(rasterizers), built);
  return rasterizers;
}

Rasterizer defaultRasterizer() {
  return builtRasterizers().front();
}

std::vector<std::string> rasterizerNames() {
  return {"osmesa", "egl", "builtin"};
}

std::string nameOf(Rasterizer rasterizer) {
  return rasterizerNames()[static_cast<std::size_t>(rasterizer)];
}

Rasterizer rasterizerNamed(const std::string& name) {
  const std::vector<std::string> names = rasterizerNames();
  return static_cast<Rasterizer>(std::find(names.begin(), names.end(), name) - names.begin());
}

void requireStarts(Rasterizer rasterizer) {
  const std::string why_not = obstacle(rasterizer);
  if (!why_not.empty()) {
    throw std::runtime_error("rasterizer " + nameOf(rasterizer) + " cannot start: " + why_not +
                             "; those that can: " + others(rasterizer));
  }
}

std::unique_ptr<Rasteriser> makeRasteriser(Rasterizer rasterizer, const RasteriserWorld& world) {
  if (rasterizer == Rasterizer::kBuiltin) return std::make_unique<BuiltinRasteriser>(world);
  requireStarts(rasterizer);
#if defined(SUNLIT_HAS_OSMESA) || defined(SUNLIT_HAS_EGL)
  return std::make_unique<gl::GlRasteriser>(deviceOf(rasterizer), world);
#else
  return nullptr;  // not reached: an obstacle was found
#endif
}

}  // namespace sunlit::render
