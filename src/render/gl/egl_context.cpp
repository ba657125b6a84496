// The only file that knows EGL.
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include "render/gl/context.h"

namespace sunlit::render::gl {
namespace {

/// Of the driver's answer to "what can you do", which is null if it cannot even say that.
bool has(const char* extensions, const std::string& name) {
  return extensions && (" " + std::string(extensions) + " ").find(" " + name + " ") != std::string::npos;
}

template <typename Pointer>
Pointer entry(const char* name) {
  return reinterpret_cast<Pointer>(eglGetProcAddress(name));
}

/// Where a context may be had: each GPU, and after them what needs none.
std::vector<EGLDisplay> displays() {
  const char* const known = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  const auto display_of = entry<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
  std::vector<EGLDisplay> found;
  if (!display_of) return found;
  const auto query = entry<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
  const auto about = entry<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
  if (has(known, "EGL_EXT_platform_device") && query && about) {
    std::array<EGLDeviceEXT, 32> devices;
    EGLint count = 0;
    query(static_cast<EGLint>(devices.size()), devices.data(), &count);
    for (EGLint i = 0; i < count; ++i) {
      EGLDeviceEXT device = devices[static_cast<std::size_t>(i)];
      if (has(about(device, EGL_EXTENSIONS), "EGL_MESA_device_software")) continue;
      found.push_back(display_of(EGL_PLATFORM_DEVICE_EXT, device, nullptr));
    }
  }
  if (has(known, "EGL_MESA_platform_surfaceless"))
    found.push_back(display_of(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
  return found;
}

class EglContext : public Context {
 public:
  EglContext() {
    std::string why = "EGL offers neither a GPU nor a surfaceless platform";
    for (const EGLDisplay display : displays()) {
      if (display == EGL_NO_DISPLAY) continue;
      why = start(display);
      if (why.empty()) return;
    }
    throw std::runtime_error(why);
  }
  ~EglContext() override {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display_, context_);
    eglReleaseThread();
  }
  Function function(const char* name) const override { return eglGetProcAddress(name); }

 private:
  /// Why not; empty if it worked. Displays stay initialised: others in this process may use them.
  std::string start(EGLDisplay display) {
    if (!eglInitialize(display, nullptr, nullptr)) return "EGL finds no driver that starts";
    if (!eglBindAPI(EGL_OPENGL_API)) return "EGL's driver has no OpenGL";
    constexpr std::array<EGLint, 5> kConfig = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                               EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (!eglChooseConfig(display, kConfig.data(), &config, 1, &count) || count == 0)
      return "EGL's driver has no configuration for OpenGL";
    constexpr std::array<EGLint, 7> kContext = {EGL_CONTEXT_MAJOR_VERSION,
                                                4,
                                                EGL_CONTEXT_MINOR_VERSION,
                                                5,
                                                EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                                EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                                EGL_NONE};
    EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, kContext.data());
    if (context == EGL_NO_CONTEXT) return "EGL's driver gives no context of OpenGL 4.5";
    if (!eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) {
      eglDestroyContext(display, context);
      return "EGL's driver draws to windows only";
    }
    display_ = display;
    context_ = context;
    return {};
  }

  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

std::unique_ptr<Context> makeEglContext() {
  return std::make_unique<EglContext>();
}

}  // namespace sunlit::render::gl
