#include <GL/osmesa.h>

#include <array>
#include <stdexcept>
#include <string>
#include <thread>

#include "render/gl_context.h"

namespace sunlit::render {

struct GlContext::Handle {
  OSMesaContext context = nullptr;
  std::thread::id thread = std::this_thread::get_id();
  /// The library insists on a default framebuffer; nothing is ever drawn to it.
  static constexpr int kSize = 16;
  std::array<unsigned char, kSize * kSize * 4> pixels{};
};

GlContext::GlContext() : handle_(std::make_unique<Handle>()) {
  const int attributes[] = {OSMESA_FORMAT,
                            OSMESA_RGBA,
                            OSMESA_DEPTH_BITS,
                            0,
                            OSMESA_STENCIL_BITS,
                            0,
                            OSMESA_PROFILE,
                            OSMESA_CORE_PROFILE,
                            OSMESA_CONTEXT_MAJOR_VERSION,
                            4,
                            OSMESA_CONTEXT_MINOR_VERSION,
                            5,
                            0};
  handle_->context = OSMesaCreateContextAttribs(attributes, nullptr);
  if (!handle_->context) throw std::runtime_error("OSMesa gives no OpenGL 4.5 core context");
  makeCurrent();
}

GlContext::~GlContext() {
  OSMesaDestroyContext(handle_->context);
}

void GlContext::makeCurrent() {
  if (handle_->thread != std::this_thread::get_id()) {
    throw std::logic_error("an OpenGL context was used on a thread that did not construct it");
  }
  if (!OSMesaMakeCurrent(handle_->context, handle_->pixels.data(), GL_UNSIGNED_BYTE, Handle::kSize,
                         Handle::kSize)) {
    throw std::runtime_error("OSMesa cannot make its context current");
  }
}

GlContext::Function GlContext::function(const char* name) {
  const Function found = OSMesaGetProcAddress(name);
  if (!found) throw std::runtime_error(std::string("OSMesa has no ") + name);
  return found;
}

}  // namespace sunlit::render
