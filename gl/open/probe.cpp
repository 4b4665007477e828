#include "gl/open/probe.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <glm/gtc/packing.hpp>
#include <string_view>
#include <vector>

#include "gl/context/error.h"
#include "gl/objects/draw.h"
#include "gl/objects/program.h"
#include "gl/transfer/transfer.h"

namespace pinocchio::gl {
namespace {

constexpr glm::ivec2 kSize{8, 8};
constexpr std::uint32_t kNothing = 0xffffffffu;
constexpr float kNear = 0x1p-60f;  // the visibility pass's: lost with fixed-point or unreversed depth

// Small versions of the passes' shaders: visibility.vert, visibility.frag and one that reads their ids.
constexpr std::array<BuiltInShader, 4> kShaders{{{"probe.vert", R"(#version 330 core
layout(location = 0) in vec3 p_eye;
uniform float z_near;
void main() { gl_Position = vec4(p_eye.xy, z_near, p_eye.z); }
)"},
                                                 {"probe_ids.frag", R"(#version 330 core
out uint id;
void main() { id = uint(gl_PrimitiveID); }
)"},
                                                 {"probe_whole.vert", R"(#version 330 core
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }
)"},
                                                 {"probe_light.frag", R"(#version 330 core
uniform usampler2D ids;
uniform samplerBuffer values;
out vec4 light;
void main() {
  uint id = texelFetch(ids, ivec2(gl_FragCoord.xy), 0).r;
  light = vec4(texelFetch(values, int(id)).r, gl_FragCoord.xy, -0.25);
}
)"}}};

// Values that half floats hold exactly, with the largest.
constexpr std::array<float, 3> kValues{65504.0f, 0x1.004p-14f, 1.0f};

ShaderSource source() {
  return ShaderSource(std::span<const BuiltInShader>(kShaders));
}

// Triangles 0 and 2 cover every pixel, 1 the lower half of the rows. 1 is nearest, 2 farthest.
Framebuffer draw_ids() {
  constexpr std::array<float, 3> kDepths{2.0f, 1.0f, 3.0f};
  std::vector<glm::vec3> corners{{-9, -9, 1}, {9, -9, 1},  {0, 20, 1}, {-9, 0, 1}, {9, 0, 1},
                                 {0, -20, 1}, {-9, -9, 1}, {9, -9, 1}, {0, 20, 1}};
  for (std::size_t i = 0; i < corners.size(); ++i) corners[i] *= kDepths[i / 3];
  const Mesh mesh(corners, std::vector<glm::uvec3>{{0, 1, 2}, {3, 4, 5}, {6, 7, 8}});
  Framebuffer target(kSize, kR32Ui, true);
  const Program program(source(), "probe.vert", "probe_ids.frag");
  begin_depth_pass(target, kNothing, kSize, {0, 0});
  program.use();
  program.set("z_near", kNear);
  mesh.draw();
  return target;
}

std::uint32_t expected_id(int y) {
  return y < kSize.y / 2 ? 1u : 0u;
}

std::vector<std::byte> pixels_of(const Framebuffer& from) {
  Readback back;
  back.start(from);
  const std::span<const std::byte> bytes = back.open();
  std::vector<std::byte> pixels(bytes.begin(), bytes.end());
  back.close();
  return pixels;
}

// What is wrong. Empty: nothing.
std::string_view check_ids(const Framebuffer& drawn) {
  const std::vector<std::byte> bytes = pixels_of(drawn);
  std::vector<std::uint32_t> ids(bytes.size() / sizeof(std::uint32_t));
  std::memcpy(ids.data(), bytes.data(), bytes.size());
  if (std::ranges::count(ids, kNothing) == std::ssize(ids))
    return "draws nothing where a shader reads gl_PrimitiveID and depth is reversed";
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < ids.size(); ++i) wrong += ids[i] != expected_id(int(i) / kSize.x) ? 1u : 0u;
  return wrong > 0 ? "draws other triangles than the nearest (gl_PrimitiveID, glClipControl, float depth)"
                   : "";
}

std::string_view check_light(const Framebuffer& ids) {
  const TextureBuffer values(std::span<const float>(kValues), GL_R32F, sizeof(float));
  const Framebuffer target(kSize, kRgba16F, false);
  const Program program(source(), "probe_whole.vert", "probe_light.frag");
  begin_fullscreen_pass(target);
  program.use();
  program.set("ids", 0, ids.color());
  program.set("values", 1, values);
  FullscreenTriangle().draw();
  std::vector<std::uint16_t> expected;
  for (int y = 0; y < kSize.y; ++y)
    for (int x = 0; x < kSize.x; ++x)
      for (const float channel : {kValues[expected_id(y)], float(x) + 0.5f, float(y) + 0.5f, -0.25f})
        expected.push_back(glm::packHalf1x16(channel));
  return std::ranges::equal(pixels_of(target), std::as_bytes(std::span(expected)))
             ? ""
             : "does not give back what was drawn into a target of half floats";
}

}  // namespace

void probe(const ContextInfo& info) {
  std::string wrong;
  try {
    const Framebuffer ids = draw_ids();
    wrong = check_ids(ids);
    if (wrong.empty()) wrong = check_light(ids);
  } catch (const Error& error) {
    wrong = std::string("fails: ") + error.what();
  }
  glUseProgram(0);  // a program in use is deleted only when another replaces it
  if (!wrong.empty()) throw Error("its driver, " + info.renderer + " (" + info.version + "), " + wrong);
}

}  // namespace pinocchio::gl
