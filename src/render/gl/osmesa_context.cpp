// The only file that knows OSMesa.
#include <GL/osmesa.h>

#include <array>
#include <cstdint>
#include <stdexcept>

#include "render/gl/context.h"

namespace sunlit::render::gl {
namespace {

class OsmesaContext : public Context {
 public:
  OsmesaContext() {
    constexpr std::array<int, 9> kAttributes = {OSMESA_FORMAT,
                                                OSMESA_RGBA,
                                                OSMESA_PROFILE,
                                                OSMESA_CORE_PROFILE,
                                                OSMESA_CONTEXT_MAJOR_VERSION,
                                                4,
                                                OSMESA_CONTEXT_MINOR_VERSION,
                                                5,
                                                0};
    context_ = OSMesaCreateContextAttribs(kAttributes.data(), nullptr);
    if (!context_) throw std::runtime_error("OSMesa gives no context of OpenGL 4.5");
    // Needs a picture of its own to be current; what is drawn goes elsewhere.
    if (OSMesaMakeCurrent(context_, own_picture_.data(), GL_UNSIGNED_BYTE, 1, 1)) return;
    OSMesaDestroyContext(context_);
    throw std::runtime_error("OSMesa cannot make its context current");
  }
  ~OsmesaContext() override {
    OSMesaMakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
    OSMesaDestroyContext(context_);
  }
  Function function(const char* name) const override { return OSMesaGetProcAddress(name); }

 private:
  std::array<std::uint8_t, 4> own_picture_{};
  OSMesaContext context_;
};

}  // namespace

std::unique_ptr<Context> makeOsmesaContext() {
  return std::make_unique<OsmesaContext>();
}

}  // namespace sunlit::render::gl
