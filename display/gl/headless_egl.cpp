#include "display/gl/headless_egl.hpp"

#include <dlfcn.h>
#include <epoxy/egl.h>

#include <array>
#include <cstdio>

namespace yars::display::gl {

namespace {

class HeadlessContext final : public Context {
 public:
  HeadlessContext(EGLDisplay display, EGLContext context, EGLSurface surface)
      : display_(display), context_(context), surface_(surface) {}
  // Does not end the display: that unloads the driver, and the next context would load it again.
  ~HeadlessContext() override {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (surface_ != EGL_NO_SURFACE) eglDestroySurface(display_, surface_);
    eglDestroyContext(display_, context_);
  }

 private:
  EGLDisplay display_;
  EGLContext context_;
  EGLSurface surface_;
};

constexpr const char* kLibrary = "libEGL.so.1";
constexpr const char* kInstall = "install libegl1 and libgl1-mesa-dri";

failure::Expected<std::unique_ptr<Context>> no_context(const char* step) {
  std::array<char, 16> code{};
  std::snprintf(code.data(), code.size(), "0x%04x", static_cast<unsigned>(eglGetError()));
  return failure::fail("headless display", "OpenGL 3.3 through EGL", std::string(step) + " failed with " + code.data(),
                       kInstall);
}

// epoxy ends the program where it cannot open the library; so it is opened here first, and stays.
failure::Expected<void> open_library() {
  static const void* const library = dlopen(kLibrary, RTLD_LAZY | RTLD_LOCAL);
  if (library != nullptr) return {};
  const char* why = dlerror();
  return failure::fail("headless display", kLibrary, why != nullptr ? why : "none that can be opened", kInstall);
}

EGLDisplay initialized(EGLDisplay display) {
  EGLint major = 0;
  EGLint minor = 0;
  if (display == EGL_NO_DISPLAY || eglInitialize(display, &major, &minor) != EGL_TRUE) return EGL_NO_DISPLAY;
  return display;
}

EGLDisplay open_display() {
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
    const EGLDisplay surfaceless =
        initialized(eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
    if (surfaceless != EGL_NO_DISPLAY) return surfaceless;
  }
  return initialized(eglGetDisplay(EGL_DEFAULT_DISPLAY));
}

}  // namespace

failure::Expected<std::unique_ptr<Context>> open_headless() {
  if (const auto library = open_library(); !library) return tl::unexpected(library.error());
  const EGLDisplay display = open_display();
  if (display == EGL_NO_DISPLAY) return no_context("eglInitialize");
  if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) return no_context("eglBindAPI(EGL_OPENGL_API)");

  constexpr std::array<EGLint, 5> kConfig{EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                          EGL_NONE};
  EGLConfig config = nullptr;
  EGLint configs = 0;
  if (eglChooseConfig(display, kConfig.data(), &config, 1, &configs) != EGL_TRUE || configs == 0) {
    return no_context("eglChooseConfig");
  }
  constexpr std::array<EGLint, 7> kContext{
      EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
  const EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, kContext.data());
  if (context == EGL_NO_CONTEXT) return no_context("eglCreateContext");

  // Drivers that cannot do without a surface get the smallest one; nothing is drawn into it.
  EGLSurface surface = EGL_NO_SURFACE;
  if (!epoxy_has_egl_extension(display, "EGL_KHR_surfaceless_context")) {
    constexpr std::array<EGLint, 5> kSurface{EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
    surface = eglCreatePbufferSurface(display, config, kSurface.data());
  }
  auto owner = std::make_unique<HeadlessContext>(display, context, surface);
  if (eglMakeCurrent(display, surface, surface, context) != EGL_TRUE) return no_context("eglMakeCurrent");
  return owner;
}

}  // namespace yars::display::gl
