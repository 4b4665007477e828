// Drops a file on a window as a file manager does, by the XDND protocol, version 5
// (https://www.freedesktop.org/wiki/Specifications/XDND): drop_file WINDOW X Y URI, X and Y on the screen. It
// ends with 0 once the window has taken the drop.
#include <X11/Xatom.h>
#include <X11/Xlib.h>
#include <poll.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

constexpr int kPatience_ms = 30'000;

class Source {
 public:
  Source(Display* display, Window target, std::string uri)
      : display_(display),
        target_(target),
        uri_(std::move(uri)),
        own_(XCreateSimpleWindow(display, DefaultRootWindow(display), 0, 0, 1, 1, 0, 0, 0)) {
    XSetSelectionOwner(display_, atom("XdndSelection"), own_, CurrentTime);
  }

  // Whether the window has taken it.
  bool drop(long x, long y) {
    constexpr long kVersion = 5;
    const long copy = static_cast<long>(atom("XdndActionCopy"));
    send("XdndEnter", {kVersion << 24, static_cast<long>(atom("text/uri-list")), 0, 0});
    send("XdndPosition", {0, (x << 16) | y, CurrentTime, copy});
    XClientMessageEvent answer{};
    if (!await("XdndStatus", answer) || (answer.data.l[1] & 1) == 0) return false;
    send("XdndDrop", {0, CurrentTime, 0, 0});
    return await("XdndFinished", answer) && answer.data.l[1] != 0;  // GLFW says how many bytes
  }

 private:
  Atom atom(const char* name) { return XInternAtom(display_, name, False); }

  void send(const char* message, const std::array<long, 4>& data) {
    XEvent event{};
    event.xclient.type = ClientMessage;
    event.xclient.window = target_;
    event.xclient.message_type = atom(message);
    event.xclient.format = 32;
    event.xclient.data.l[0] = static_cast<long>(own_);
    for (std::size_t i = 0; i < data.size(); ++i) event.xclient.data.l[i + 1] = data[i];
    XSendEvent(display_, target_, False, NoEventMask, &event);
    XFlush(display_);
  }

  // What is dropped is given to whom asks for it meanwhile.
  bool await(const char* message, XClientMessageEvent& answer) {
    const Atom wanted = atom(message);
    for (;;) {
      while (XPending(display_) > 0) {
        XEvent event;
        XNextEvent(display_, &event);
        if (event.type == SelectionRequest) give(event.xselectionrequest);
        if (event.type != ClientMessage || event.xclient.message_type != wanted) continue;
        answer = event.xclient;
        return true;
      }
      pollfd input{ConnectionNumber(display_), POLLIN, 0};
      if (poll(&input, 1, kPatience_ms) <= 0) return false;
    }
  }

  void give(const XSelectionRequestEvent& request) {
    XChangeProperty(display_, request.requestor, request.property, request.target, 8, PropModeReplace,
                    reinterpret_cast<const unsigned char*>(uri_.data()), static_cast<int>(uri_.size()));
    XEvent event{};
    event.xselection = {
        SelectionNotify,  0,           False, display_, request.requestor, request.selection, request.target,
        request.property, request.time};
    XSendEvent(display_, request.requestor, False, NoEventMask, &event);
    XFlush(display_);
  }

  Display* display_;
  Window target_;
  std::string uri_;
  Window own_;
};

}  // namespace

int main(int argc, char** argv) {
  Display* const display = argc == 5 ? XOpenDisplay(nullptr) : nullptr;
  if (!display) {
    std::fprintf(stderr, "drop_file WINDOW X Y URI, and a display\n");
    return 2;
  }
  Source source(display, std::strtoul(argv[1], nullptr, 0), std::string(argv[4]) + "\r\n");
  const bool taken = source.drop(std::atol(argv[2]), std::atol(argv[3]));
  XCloseDisplay(display);
  return taken ? 0 : 1;
}
