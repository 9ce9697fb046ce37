// SPDX-License-Identifier: BSD-3-Clause
#include "visualization/display/gl_display.h"

#include "pcl_sq/exception.h"

#include <GL/glx.h>

#include <cstdlib>
#include <string>

namespace pcl_sq {
namespace {

/** \brief Xlib's own handler of a refused request ends the process: count instead. */
class RefusalCounter {
public:
  RefusalCounter() : previous_(XSetErrorHandler(&count)) { refusals_ = 0; }
  ~RefusalCounter() { XSetErrorHandler(previous_); }
  RefusalCounter(const RefusalCounter&) = delete;
  RefusalCounter& operator=(const RefusalCounter&) = delete;
  int refusals() const { return refusals_; }

private:
  static int count(Display*, XErrorEvent*) { return ++refusals_; }
  static int refusals_;
  XErrorHandler previous_;
};
int RefusalCounter::refusals_ = 0;

/** \brief Whether an OpenGL 3.2 context, VTK's least, can be made. */
bool canRender(Display* display) {
  int error_base = 0, event_base = 0;
  if (glXQueryExtension(display, &error_base, &event_base) == 0)
    return false;
  const int wanted[] = {GLX_DRAWABLE_TYPE,
                        GLX_WINDOW_BIT,
                        GLX_RENDER_TYPE,
                        GLX_RGBA_BIT,
                        GLX_RED_SIZE,
                        8,
                        GLX_GREEN_SIZE,
                        8,
                        GLX_BLUE_SIZE,
                        8,
                        GLX_DEPTH_SIZE,
                        1,
                        GLX_DOUBLEBUFFER,
                        1,
                        0};
  int count = 0;
  GLXFBConfig* configs =
      glXChooseFBConfig(display, DefaultScreen(display), wanted, &count);
  if (configs == nullptr)
    return false;
  GLXFBConfig config = count > 0 ? configs[0] : nullptr;
  XFree(configs);
  const auto create =
      reinterpret_cast<PFNGLXCREATECONTEXTATTRIBSARBPROC>(glXGetProcAddressARB(
          reinterpret_cast<const GLubyte*>("glXCreateContextAttribsARB")));
  if (config == nullptr || create == nullptr)
    return false;

  const RefusalCounter counter;
  const int version[] = {
      GLX_CONTEXT_MAJOR_VERSION_ARB, 3, GLX_CONTEXT_MINOR_VERSION_ARB, 2, 0};
  GLXContext context = create(display, config, nullptr, True, version);
  XSync(display, False);
  const bool made = context != nullptr && counter.refusals() == 0;
  if (context != nullptr)
    glXDestroyContext(display, context);
  XSync(display, False);
  return made;
}

/** \brief A connection that can render, or null. */
Display* open(const char* name) {
  Display* display = XOpenDisplay(name);
  if (display != nullptr && !canRender(display)) {
    XCloseDisplay(display);
    display = nullptr;
  }
  return display;
}

/** \brief DISPLAY if it names a display of this machine, else null. */
const char* localDisplay() {
  const char* name = std::getenv("DISPLAY"); // NOLINT(concurrency-mt-unsafe): read only
  if (name == nullptr)
    return nullptr;
  const std::string host = std::string(name).substr(0, std::string(name).find(':'));
  return host.empty() || host == "unix" || host == "localhost" ? name : nullptr;
}

} // namespace

GlDisplay::GlDisplay() {
  if (const char* name = localDisplay())
    connection_ = open(name);
  if (connection_ != nullptr)
    return;
  server_ = std::make_unique<PrivateXvfb>();
  connection_ = open(server_->name().c_str());
  if (connection_ == nullptr)
    throw Exception(
        "[pcl_sq::SnapshotRenderer] Xvfb runs but has no OpenGL 3.2; install "
        "Mesa's software renderer (Debian: apt-get install "
        "libgl1-mesa-dri).");
}

GlDisplay::~GlDisplay() {
  XCloseDisplay(static_cast<Display*>(connection_));
}

} // namespace pcl_sq
