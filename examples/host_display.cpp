// Example of a host program that draws the radar display into a viewport of its own OpenGL scene.
// Scene: 1280 x 800 pixels; viewport: 600 x 600 pixels. EGL, which connects OpenGL to a window system, gives a context
// without a surface, so the example needs no window. It draws 30 x SECONDS pictures (SECONDS is 5 by default), at most
// 30 per second, and writes the last scene as a portable pixmap (PPM).
//   host_display [SESSION [FILE.ppm [SECONDS [CONFIGURATION]]]]
// CONFIGURATION is that of the set, `default.guf` for scripts/start; without it the built-in APG-70.
// Build: c++ host_display.cpp $(pkg-config --cflags --libs yars-display epoxy) -o host_display, or with the
// CMakeLists.txt beside this file. libepoxy gives OpenGL and EGL to this example; the display does not need it.
#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <time.h>
#include <yars/yars_display.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace {

constexpr int kWidth = 1280, kHeight = 800;
constexpr yars_viewport kRadarViewport{620, 100, 600, 600};

// Current OpenGL 3.3 core context of Mesa's surfaceless EGL platform.
class Context {
 public:
  Context() {
    display_ = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (eglInitialize(display_, nullptr, nullptr) != EGL_TRUE || eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) return;
    constexpr std::array<EGLint, 7> kCore33{
        EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    context_ = eglCreateContext(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, kCore33.data());
    current_ = eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_TRUE;
  }
  ~Context() {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (context_ != EGL_NO_CONTEXT) eglDestroyContext(display_, context_);
  }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  bool is_current() const { return current_; }

 private:
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
  bool current_ = false;
};

// Binds a framebuffer that takes the place of a window.
void make_canvas() {
  GLuint framebuffer = 0, pixels = 0;
  glGenFramebuffers(1, &framebuffer);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glGenRenderbuffers(1, &pixels);
  glBindRenderbuffer(GL_RENDERBUFFER, pixels);
  glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, kWidth, kHeight);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, pixels);
}

// Rectangle of one colour; [pixels] from the lower left corner.
struct Box {
  int left, bottom, width, height;
  float red, green, blue;
};

void fill(const Box& box) {
  glScissor(box.left, box.bottom, box.width, box.height);
  glClearColor(box.red, box.green, box.blue, 1.0F);
  glClear(GL_COLOR_BUFFER_BIT);
}

// Draws the scene: sky, panel, and a bezel with 20 buttons. glScissor and glClear draw the rectangles, which
// would be wrong if the radar display did not restore the OpenGL state.
void draw_cockpit() {
  glEnable(GL_SCISSOR_TEST);
  for (int row = 0; row < 20; ++row)
    fill({0, kHeight - 20 * (row + 1), kWidth, 20, 0.2F + 0.02F * static_cast<float>(row), 0.45F, 0.75F});
  fill({0, 0, kWidth, 400, 0.16F, 0.17F, 0.19F});
  fill({560, 40, 720, 720, 0.07F, 0.07F, 0.08F});
  for (int i = 0; i < 5; ++i) {
    const int along = 90 + 92 * i;
    for (const auto& [left, bottom] : std::array<std::array<int, 2>, 4>{
             {{575, 100 + along}, {1235, 100 + along}, {620 + along, 55}, {620 + along, 715}}})
      fill({left, bottom, 30, 30, 0.35F, 0.36F, 0.38F});
  }
}

bool write_canvas(const char* path) {
  constexpr std::size_t kRow = std::size_t{3} * kWidth;
  std::vector<unsigned char> pixels(kRow * kHeight);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, kWidth, kHeight, GL_RGB, GL_UNSIGNED_BYTE, pixels.data());
  std::FILE* const file = std::fopen(path, "wb");
  if (file == nullptr) {
    std::perror(path);
    return false;
  }
  std::fprintf(file, "P6\n%d %d\n255\n", kWidth, kHeight);
  // The first row that OpenGL gives is the bottom row; the first row of the file is the top row.
  for (std::size_t row = kHeight; row-- > 0;) std::fwrite(&pixels[row * kRow], 1, kRow, file);
  const bool failed = std::ferror(file) != 0;
  if (std::fclose(file) == 0 && !failed) return true;
  std::perror(path);
  return false;
}

}  // namespace

int main(int argc, char** argv) {
  const int frames = std::clamp(static_cast<int>(30.0 * (argc > 3 ? std::atof(argv[3]) : 5.0)), 1, 1'000'000);
  const Context context;  // declared first, because the context must outlive the display
  if (!context.is_current()) {
    std::fputs("expected a surfaceless EGL context, found none: install libegl1 and libgl1-mesa-dri\n", stderr);
    return 1;
  }
  make_canvas();
  yars_display* const radar_display =
      yars_display_attach(argc > 1 ? argv[1] : "default", argc > 4 ? argv[4] : nullptr, "host_display");
  if (radar_display == nullptr) {
    std::fprintf(stderr, "%s\n", yars_display_error());
    return 1;
  }
  for (int frame = 0; frame < frames; ++frame) {
    yars_display_update(radar_display);
    draw_cockpit();
    yars_display_draw(radar_display, kRadarViewport);
    yars_display_note_shown(radar_display);
    const timespec thirtieth{0, 33'000'000};
    nanosleep(&thirtieth, nullptr);
  }
  const bool written = write_canvas(argc > 2 ? argv[2] : "host_display.ppm");
  yars_display_detach(radar_display);
  return written ? 0 : 1;
}
