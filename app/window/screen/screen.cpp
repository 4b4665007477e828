#include "app/window/screen/screen.h"

#include <algorithm>
#include <utility>

#include "app/window/overlay/parts.h"
#include "core/base/clock.h"
#include "core/image/codecs/png.h"
#include "gl/objects/framebuffer.h"

namespace pinocchio::app {

Screen::Screen(gl::Window& window, Engine& engine, Model& model, const SplitView& split)
    : window_(window),
      model_(model),
      split_(split),
      gui_(window, [this] { draw_overlay(model_, gui_.scale()); }),
      present_(engine),
      histogram_(engine) {}

void Screen::set_picture(const gl::Texture* picture, bool is_light) {
  picture_ = picture;
  is_light_ = is_light;
  counted_ = false;
}

bool Screen::wants_redraw() const {
  constexpr double kCursor_s = 0.25;
  const double since_s = now_s() - redrawn_s_;
  return redraws_ > 0 || !png_file_.empty() || (model_.is_loading() && since_s >= kBetweenRedraws_s) ||
         (gui_.wants_text() && since_s > kCursor_s);
}

double Screen::until_redraw_s() const {
  return std::clamp(redrawn_s_ + kBetweenRedraws_s - now_s(), 0.0, kBetweenRedraws_s);
}

void Screen::show() {
  const glm::ivec2 pixels = window_.pixels();
  if (pixels.x < 1 || pixels.y < 1) return;
  shown_ = true;
  model_.set_window_pixels(pixels);
  draw_picture();
  if (!png_file_.empty() && !with_overlay_) write_png_file();
  gui_.draw();
  redraws_ = std::max(redraws_ - 1, 0);
  redrawn_s_ = now_s();
  if (!png_file_.empty()) write_png_file();
  window_.present();
  pace_.redrawn(now_s(), model_.is_loading());
}

void Screen::draw_picture() {
  const glm::ivec2 pixels = model_.window_pixels;
  if (!picture_) return present_.clear(pixels);
  const ViewSettings& settings = model_.applied;
  const int split = split_.is_on() ? int(settings.split_at * pixels.x) : pixels.x;
  const auto draw = [&](const gl::Texture& texture, const PixelBox& box, bool is_light) {
    present_.draw(texture, pixels, box, is_light ? settings.exposure_ev : 0.0f,
                  is_light ? settings.tone_map : ToneMap::clip, model_.zoom,
                  is_light ? model_.drawn.background.value : Background{});
  };
  draw(*picture_, {{0, 0}, {split, pixels.y}}, is_light_);
  if (!split_.is_on()) return;
  const PixelBox right{{split, 0}, pixels};
  if (const gl::Texture* const texture = split_.texture())
    draw(*texture, right, settings.split == Split::reference);
  else
    present_.clear(pixels, right);
}

Image<glm::u8vec3> Screen::read_pixels() const {
  Image<glm::u8vec3> image(model_.window_pixels);
  std::ranges::copy(gl::read_window(model_.window_pixels), image.pixels().begin());
  return image;
}

Image<glm::u8vec3> Screen::read_picture() {
  draw_picture();
  return read_pixels();
}

void Screen::write_png_file() {
  const std::string file = std::exchange(png_file_, {});
  try {
    write_png(file, read_pixels());
    std::error_code unknown;
    const std::filesystem::path path = std::filesystem::absolute(file, unknown);
    model_.messages.news(path.string() + " and " + path.stem().string() + ".exr written");
  } catch (const EnvironmentError& error) {
    model_.messages.error("file", error.what());
  }
}

void Screen::count_light() {
  constexpr double kBetween_s = 0.5;
  if (!model_.panels[Panel::drawing] || !picture_ || !is_light_) {
    if (model_.histogram) request_redraw();  // the panel becomes smaller
    model_.histogram.reset();
    counted_ = false;
    return;
  }
  if (histogram_.started()) {
    request_redraw(model_.histogram ? 1 : kSettling);  // the panel becomes larger
    model_.histogram.emplace(histogram_.take());
  }
  if (counted_ || (model_.histogram && !model_.idle && now_s() - counted_s_ < kBetween_s)) return;
  histogram_.start(*picture_);
  counted_ = true;
  counted_s_ = now_s();
  request_redraw(1);  // the count is read then
}

}  // namespace pinocchio::app
