#include "tests/view/screen.h"

#include <cstdlib>
#include <cstring>
#include <string_view>

namespace pinocchio {
namespace {

// A reply, or nothing; its errors are freed unread. Called as xcb calls it: REPLY(connection, cookie,
// &error).
template <class Reply, class Cookie>
std::unique_ptr<Reply, void (*)(void*)> reply_of(Reply* (*reply)(xcb_connection_t*, Cookie,
                                                                 xcb_generic_error_t**),
                                                 xcb_connection_t* connection, Cookie cookie) {
  xcb_generic_error_t* error = nullptr;
  std::unique_ptr<Reply, void (*)(void*)> answer(reply(connection, cookie, &error), std::free);
  std::free(error);
  return answer;
}

}  // namespace

Screen::Screen(const std::string& display)
    : connection_(xcb_connect(display.c_str(), nullptr), xcb_disconnect) {
  xcb_connection_t* const c = connection_.get();
  if (xcb_connection_has_error(c)) return;
  const xcb_screen_t* const screen = xcb_setup_roots_iterator(xcb_get_setup(c)).data;
  root_ = screen->root;
  size_ = {screen->width_in_pixels, screen->height_in_pixels};
  constexpr std::string_view kActive = "_NET_ACTIVE_WINDOW";
  const auto atom = reply_of(xcb_intern_atom_reply, c, xcb_intern_atom(c, 0, kActive.size(), kActive.data()));
  if (atom) active_ = atom->atom;
}

Picture Screen::picture_of(xcb_window_t window) const {
  xcb_connection_t* const c = connection_.get();
  const auto inside = reply_of(xcb_get_geometry_reply, c, xcb_get_geometry(c, window));
  const auto place =
      reply_of(xcb_translate_coordinates_reply, c, xcb_translate_coordinates(c, window, root_, 0, 0));
  if (!inside || !place) return {};
  const glm::ivec2 corner(place->dst_x, place->dst_y);
  const glm::ivec2 from = glm::max(corner, glm::ivec2(0)),
                   to = glm::min(corner + glm::ivec2(inside->width, inside->height), size_);
  if (from.x >= to.x || from.y >= to.y) return {};
  const glm::ivec2 size = to - from;
  const auto image =
      reply_of(xcb_get_image_reply, c,
               xcb_get_image(c, XCB_IMAGE_FORMAT_Z_PIXMAP, root_, static_cast<std::int16_t>(from.x),
                             static_cast<std::int16_t>(from.y), static_cast<std::uint16_t>(size.x),
                             static_cast<std::uint16_t>(size.y), ~0u));
  if (!image || image->depth != 24) return {};
  Picture picture(size);  // 24 bits of colour are kept in 32: blue, green, red, nothing
  const std::uint8_t* byte = xcb_get_image_data(image.get());
  for (glm::u8vec3& pixel : picture.pixels()) {
    pixel = {byte[2], byte[1], byte[0]};
    byte += 4;
  }
  return picture;
}

xcb_window_t Screen::active_window() const {
  xcb_connection_t* const c = connection_.get();
  const auto property =
      reply_of(xcb_get_property_reply, c, xcb_get_property(c, 0, root_, active_, XCB_ATOM_WINDOW, 0, 1));
  if (!property || xcb_get_property_value_length(property.get()) < static_cast<int>(sizeof(xcb_window_t)))
    return 0;
  xcb_window_t window = 0;
  std::memcpy(&window, xcb_get_property_value(property.get()), sizeof window);
  return window;
}

}  // namespace pinocchio
