#include "core/image/codecs/png.h"

#include <gtest/gtest.h>
#include "tests/support/own_file.h"

#include <memory>

#include "pinocchio/error.h"
#include "tests/support/stb_image.h"

namespace pinocchio {
namespace {

TEST(Png, TextComesBackFromWholeFilesAlone) {
  const Image<glm::u8vec3> pixels({64, 48});
  const std::filesystem::path file = own_file("text.png");
  write_png(file, pixels);
  EXPECT_EQ(text_of_png(file), std::nullopt);
  const std::string text(3000, 'x');
  write_png(file, pixels, text);
  EXPECT_EQ(text_of_png(file), text);
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 20);
  EXPECT_EQ(text_of_png(file), std::nullopt);
  EXPECT_EQ(text_of_png(own_folder()), std::nullopt);
  EXPECT_EQ(text_of_png(own_file("missing.png")), std::nullopt);
}

TEST(Png, PixelsComeBackFromTheTopLeft) {
  Image<glm::u8vec3> written({5, 3});
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 5; ++x) written.at(x, y) = glm::u8vec3(10 * x, 20 * y, 255 - x - y);
  const std::filesystem::path file = own_file("back.png");
  write_png(file, written);

  int width = 0, height = 0, channels = 0;
  const std::unique_ptr<stbi_uc, void (*)(void*)> read(stbi_load(file.c_str(), &width, &height, &channels, 0),
                                                       stbi_image_free);
  ASSERT_NE(read, nullptr) << stbi_failure_reason();
  ASSERT_EQ(glm::ivec3(width, height, channels), glm::ivec3(5, 3, 3));
  const stbi_uc* byte = read.get();
  for (const glm::u8vec3& pixel : written.pixels())
    for (int c = 0; c < 3; ++c) EXPECT_EQ(*byte++, pixel[c]);
}

TEST(Png, WhereNothingCanBeWrittenThrows) {
  const Image<glm::u8vec3> pixels({1, 1});
  EXPECT_THROW(write_png("/dev/full", pixels), EnvironmentError);
  EXPECT_THROW(write_png(own_folder() / "nowhere" / "x.png", pixels), EnvironmentError);
}

}  // namespace
}  // namespace pinocchio
