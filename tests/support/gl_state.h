// The state of a context, as far as OpenGL can be asked for it, to compare before with after.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "gl/context/functions.h"

namespace pinocchio {

using GlState = std::map<std::string, std::vector<double>>;

// 33, 45: the OpenGL version of the context that is current.
inline int gl_version() {
  GLint major = 0, minor = 0;
  glGetIntegerv(GL_MAJOR_VERSION, &major);
  glGetIntegerv(GL_MINOR_VERSION, &minor);
  return 10 * major + minor;
}

namespace gl_state {

// Names as they are spelled.
#define PINOCCHIO_NAMED(name)      \
  std::pair<const char*, GLenum> { \
#name, name                    \
  }

inline void read_numbers(GlState& state) {
  const std::pair<const char*, GLenum> kNames[] = {PINOCCHIO_NAMED(GL_ACTIVE_TEXTURE),
                                                   PINOCCHIO_NAMED(GL_ARRAY_BUFFER_BINDING),
                                                   PINOCCHIO_NAMED(GL_ATOMIC_COUNTER_BUFFER_BINDING),
                                                   PINOCCHIO_NAMED(GL_BLEND_COLOR),
                                                   PINOCCHIO_NAMED(GL_CLAMP_READ_COLOR),
                                                   PINOCCHIO_NAMED(GL_CLIP_DEPTH_MODE),
                                                   PINOCCHIO_NAMED(GL_CLIP_ORIGIN),
                                                   PINOCCHIO_NAMED(GL_COLOR_CLEAR_VALUE),
                                                   PINOCCHIO_NAMED(GL_COPY_READ_BUFFER_BINDING),
                                                   PINOCCHIO_NAMED(GL_COPY_WRITE_BUFFER_BINDING),
                                                   PINOCCHIO_NAMED(GL_CULL_FACE_MODE),
                                                   PINOCCHIO_NAMED(GL_CURRENT_PROGRAM),
                                                   PINOCCHIO_NAMED(GL_DEPTH_CLEAR_VALUE),
                                                   PINOCCHIO_NAMED(GL_DEPTH_FUNC),
                                                   PINOCCHIO_NAMED(GL_DEPTH_WRITEMASK),
                                                   PINOCCHIO_NAMED(GL_DISPATCH_INDIRECT_BUFFER_BINDING),
                                                   PINOCCHIO_NAMED(GL_DRAW_FRAMEBUFFER_BINDING),
                                                   PINOCCHIO_NAMED(GL_DRAW_INDIRECT_BUFFER_BINDING),
                                                   PINOCCHIO_NAMED(GL_FRAGMENT_SHADER_DERIVATIVE_HINT),
                                                   PINOCCHIO_NAMED(GL_FRONT_FACE),
                                                   PINOCCHIO_NAMED(GL_LINE_WIDTH),
                                                   PINOCCHIO_NAMED(GL_LOGIC_OP_MODE),
                                                   PINOCCHIO_NAMED(GL_MIN_SAMPLE_SHADING_VALUE),
                                                   PINOCCHIO_NAMED(GL_PATCH_VERTICES),
                                                   PINOCCHIO_NAMED(GL_PIXEL_PACK_BUFFER_BINDING),
                                                   PINOCCHIO_NAMED(GL_PIXEL_UNPACK_BUFFER_BINDING),
                                                   PINOCCHIO_NAMED(GL_POINT_FADE_THRESHOLD_SIZE),
                                                   PINOCCHIO_NAMED(GL_POINT_SIZE),
                                                   PINOCCHIO_NAMED(GL_POINT_SPRITE_COORD_ORIGIN),
                                                   PINOCCHIO_NAMED(GL_POLYGON_MODE),
                                                   PINOCCHIO_NAMED(GL_POLYGON_OFFSET_CLAMP_EXT),
                                                   PINOCCHIO_NAMED(GL_POLYGON_OFFSET_FACTOR),
                                                   PINOCCHIO_NAMED(GL_POLYGON_OFFSET_UNITS),
                                                   PINOCCHIO_NAMED(GL_PRIMITIVE_RESTART_INDEX),
                                                   PINOCCHIO_NAMED(GL_PROGRAM_PIPELINE_BINDING),
                                                   PINOCCHIO_NAMED(GL_PROVOKING_VERTEX),
                                                   PINOCCHIO_NAMED(GL_QUERY_BUFFER_BINDING),
                                                   PINOCCHIO_NAMED(GL_READ_FRAMEBUFFER_BINDING),
                                                   PINOCCHIO_NAMED(GL_RENDERBUFFER_BINDING),
                                                   PINOCCHIO_NAMED(GL_SAMPLE_COVERAGE_INVERT),
                                                   PINOCCHIO_NAMED(GL_SAMPLE_COVERAGE_VALUE),
                                                   PINOCCHIO_NAMED(GL_SHADER_STORAGE_BUFFER_BINDING),
                                                   PINOCCHIO_NAMED(GL_STENCIL_BACK_FAIL),
                                                   PINOCCHIO_NAMED(GL_STENCIL_BACK_FUNC),
                                                   PINOCCHIO_NAMED(GL_STENCIL_BACK_PASS_DEPTH_FAIL),
                                                   PINOCCHIO_NAMED(GL_STENCIL_BACK_PASS_DEPTH_PASS),
                                                   PINOCCHIO_NAMED(GL_STENCIL_BACK_REF),
                                                   PINOCCHIO_NAMED(GL_STENCIL_BACK_VALUE_MASK),
                                                   PINOCCHIO_NAMED(GL_STENCIL_BACK_WRITEMASK),
                                                   PINOCCHIO_NAMED(GL_STENCIL_CLEAR_VALUE),
                                                   PINOCCHIO_NAMED(GL_STENCIL_FAIL),
                                                   PINOCCHIO_NAMED(GL_STENCIL_FUNC),
                                                   PINOCCHIO_NAMED(GL_STENCIL_PASS_DEPTH_FAIL),
                                                   PINOCCHIO_NAMED(GL_STENCIL_PASS_DEPTH_PASS),
                                                   PINOCCHIO_NAMED(GL_STENCIL_REF),
                                                   PINOCCHIO_NAMED(GL_STENCIL_VALUE_MASK),
                                                   PINOCCHIO_NAMED(GL_STENCIL_WRITEMASK),
                                                   PINOCCHIO_NAMED(GL_TRANSFORM_FEEDBACK_ACTIVE),
                                                   PINOCCHIO_NAMED(GL_TRANSFORM_FEEDBACK_BINDING),
                                                   PINOCCHIO_NAMED(GL_TRANSFORM_FEEDBACK_BUFFER_BINDING),
                                                   PINOCCHIO_NAMED(GL_TRANSFORM_FEEDBACK_PAUSED),
                                                   PINOCCHIO_NAMED(GL_UNIFORM_BUFFER_BINDING),
                                                   PINOCCHIO_NAMED(GL_VERTEX_ARRAY_BINDING),
                                                   PINOCCHIO_NAMED(GL_PACK_ALIGNMENT),
                                                   PINOCCHIO_NAMED(GL_PACK_IMAGE_HEIGHT),
                                                   PINOCCHIO_NAMED(GL_PACK_LSB_FIRST),
                                                   PINOCCHIO_NAMED(GL_PACK_ROW_LENGTH),
                                                   PINOCCHIO_NAMED(GL_PACK_SKIP_IMAGES),
                                                   PINOCCHIO_NAMED(GL_PACK_SKIP_PIXELS),
                                                   PINOCCHIO_NAMED(GL_PACK_SKIP_ROWS),
                                                   PINOCCHIO_NAMED(GL_PACK_SWAP_BYTES),
                                                   PINOCCHIO_NAMED(GL_UNPACK_ALIGNMENT),
                                                   PINOCCHIO_NAMED(GL_UNPACK_IMAGE_HEIGHT),
                                                   PINOCCHIO_NAMED(GL_UNPACK_LSB_FIRST),
                                                   PINOCCHIO_NAMED(GL_UNPACK_ROW_LENGTH),
                                                   PINOCCHIO_NAMED(GL_UNPACK_SKIP_IMAGES),
                                                   PINOCCHIO_NAMED(GL_UNPACK_SKIP_PIXELS),
                                                   PINOCCHIO_NAMED(GL_UNPACK_SKIP_ROWS),
                                                   PINOCCHIO_NAMED(GL_UNPACK_SWAP_BYTES)};
  for (const auto& [text, name] : kNames) {
    std::vector<double> values(4);
    glGetDoublev(name, values.data());
    state[text] = values;
  }
}

inline void read_capabilities(GlState& state) {
  const std::pair<const char*, GLenum> kNames[] = {PINOCCHIO_NAMED(GL_COLOR_LOGIC_OP),
                                                   PINOCCHIO_NAMED(GL_CULL_FACE),
                                                   PINOCCHIO_NAMED(GL_DEBUG_OUTPUT),
                                                   PINOCCHIO_NAMED(GL_DEBUG_OUTPUT_SYNCHRONOUS),
                                                   PINOCCHIO_NAMED(GL_DEPTH_CLAMP),
                                                   PINOCCHIO_NAMED(GL_DEPTH_TEST),
                                                   PINOCCHIO_NAMED(GL_DITHER),
                                                   PINOCCHIO_NAMED(GL_FRAMEBUFFER_SRGB),
                                                   PINOCCHIO_NAMED(GL_LINE_SMOOTH),
                                                   PINOCCHIO_NAMED(GL_MULTISAMPLE),
                                                   PINOCCHIO_NAMED(GL_POLYGON_OFFSET_FILL),
                                                   PINOCCHIO_NAMED(GL_POLYGON_OFFSET_LINE),
                                                   PINOCCHIO_NAMED(GL_POLYGON_OFFSET_POINT),
                                                   PINOCCHIO_NAMED(GL_POLYGON_SMOOTH),
                                                   PINOCCHIO_NAMED(GL_PRIMITIVE_RESTART),
                                                   PINOCCHIO_NAMED(GL_PRIMITIVE_RESTART_FIXED_INDEX),
                                                   PINOCCHIO_NAMED(GL_PROGRAM_POINT_SIZE),
                                                   PINOCCHIO_NAMED(GL_RASTERIZER_DISCARD),
                                                   PINOCCHIO_NAMED(GL_SAMPLE_ALPHA_TO_COVERAGE),
                                                   PINOCCHIO_NAMED(GL_SAMPLE_ALPHA_TO_ONE),
                                                   PINOCCHIO_NAMED(GL_SAMPLE_COVERAGE),
                                                   PINOCCHIO_NAMED(GL_SAMPLE_MASK),
                                                   PINOCCHIO_NAMED(GL_SAMPLE_SHADING),
                                                   PINOCCHIO_NAMED(GL_STENCIL_TEST),
                                                   PINOCCHIO_NAMED(GL_TEXTURE_CUBE_MAP_SEAMLESS),
                                                   PINOCCHIO_NAMED(GL_CLIP_DISTANCE0),
                                                   PINOCCHIO_NAMED(GL_CLIP_DISTANCE1),
                                                   PINOCCHIO_NAMED(GL_CLIP_DISTANCE2),
                                                   PINOCCHIO_NAMED(GL_CLIP_DISTANCE3),
                                                   PINOCCHIO_NAMED(GL_CLIP_DISTANCE4),
                                                   PINOCCHIO_NAMED(GL_CLIP_DISTANCE5),
                                                   PINOCCHIO_NAMED(GL_CLIP_DISTANCE6),
                                                   PINOCCHIO_NAMED(GL_CLIP_DISTANCE7)};
  for (const auto& [text, name] : kNames) state[text] = {static_cast<double>(glIsEnabled(name))};
}

// One vector of all of a kind.
inline void read_indexed(GlState& state) {
  const auto limit = [](GLenum name) {
    GLint value = 0;
    glGetIntegerv(name, &value);
    return static_cast<GLuint>(value);
  };
  const auto append = [&state](const std::string& name, GLenum query, GLuint index, int count) {
    GLdouble values[4] = {};
    GLint whole[4] = {};
    if (glGetDoublei_v) {
      glGetDoublei_v(query, index, values);
    } else {  // before OpenGL 4.1
      glGetIntegeri_v(query, index, whole);
      std::copy_n(whole, 4, values);
    }
    state[name].insert(state[name].end(), values, values + count);
  };
  if (gl_version() < 41) {
    for (const GLenum name :
         {GL_VIEWPORT, GL_SCISSOR_BOX, GL_DEPTH_RANGE, GL_BLEND_SRC_RGB, GL_BLEND_DST_RGB}) {
      GLdouble values[4] = {};
      glGetDoublev(name, values);
      state["one for all"].insert(state["one for all"].end(), values, values + 4);
    }
    state["GL_SCISSOR_TEST"] = {static_cast<double>(glIsEnabled(GL_SCISSOR_TEST))};
  }
  for (GLuint i = 0; i < limit(GL_MAX_VIEWPORTS); ++i) {
    append("GL_VIEWPORT", GL_VIEWPORT, i, 4);
    append("GL_SCISSOR_BOX", GL_SCISSOR_BOX, i, 4);
    append("GL_DEPTH_RANGE", GL_DEPTH_RANGE, i, 2);
    state["GL_SCISSOR_TEST"].push_back(glIsEnabledi(GL_SCISSOR_TEST, i));
  }
  const std::pair<const char*, GLenum> kBlend[] = {
      PINOCCHIO_NAMED(GL_BLEND_DST_ALPHA),      PINOCCHIO_NAMED(GL_BLEND_DST_RGB),
      PINOCCHIO_NAMED(GL_BLEND_EQUATION_ALPHA), PINOCCHIO_NAMED(GL_BLEND_EQUATION_RGB),
      PINOCCHIO_NAMED(GL_BLEND_SRC_ALPHA),      PINOCCHIO_NAMED(GL_BLEND_SRC_RGB)};
  for (GLuint i = 0; i < limit(GL_MAX_DRAW_BUFFERS); ++i) {
    state["GL_BLEND"].push_back(glIsEnabledi(GL_BLEND, i));
    append("GL_COLOR_WRITEMASK", GL_COLOR_WRITEMASK, i, 4);
    for (const auto& [text, name] : kBlend) append(text, name, i, 1);
  }
  append("GL_SAMPLE_MASK_VALUE", GL_SAMPLE_MASK_VALUE, 0, 1);
  for (GLuint i = 0; i < limit(GL_MAX_UNIFORM_BUFFER_BINDINGS); ++i)
    append("uniform buffers", GL_UNIFORM_BUFFER_BINDING, i, 1);
  for (GLuint i = 0; i < limit(GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS); ++i)
    append("storage buffers", GL_SHADER_STORAGE_BUFFER_BINDING, i, 1);
  for (GLuint i = 0; i < limit(GL_MAX_ATOMIC_COUNTER_BUFFER_BINDINGS); ++i)
    append("atomic counter buffers", GL_ATOMIC_COUNTER_BUFFER_BINDING, i, 1);
  for (GLuint i = 0; i < limit(GL_MAX_IMAGE_UNITS); ++i) append("images", GL_IMAGE_BINDING_NAME, i, 1);
}

inline void read_units(GlState& state) {
  const std::pair<const char*, GLenum> kNames[] = {PINOCCHIO_NAMED(GL_SAMPLER_BINDING),
                                                   PINOCCHIO_NAMED(GL_TEXTURE_BINDING_1D),
                                                   PINOCCHIO_NAMED(GL_TEXTURE_BINDING_1D_ARRAY),
                                                   PINOCCHIO_NAMED(GL_TEXTURE_BINDING_2D),
                                                   PINOCCHIO_NAMED(GL_TEXTURE_BINDING_2D_ARRAY),
                                                   PINOCCHIO_NAMED(GL_TEXTURE_BINDING_2D_MULTISAMPLE),
                                                   PINOCCHIO_NAMED(GL_TEXTURE_BINDING_2D_MULTISAMPLE_ARRAY),
                                                   PINOCCHIO_NAMED(GL_TEXTURE_BINDING_3D),
                                                   PINOCCHIO_NAMED(GL_TEXTURE_BINDING_BUFFER),
                                                   PINOCCHIO_NAMED(GL_TEXTURE_BINDING_CUBE_MAP),
                                                   PINOCCHIO_NAMED(GL_TEXTURE_BINDING_CUBE_MAP_ARRAY),
                                                   PINOCCHIO_NAMED(GL_TEXTURE_BINDING_RECTANGLE)};
  GLint units = 0, active = 0;
  glGetIntegerv(GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS, &units);
  glGetIntegerv(GL_ACTIVE_TEXTURE, &active);
  for (GLint unit = 0; unit < units; ++unit) {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    for (const auto& [text, name] : kNames) {
      GLint bound = 0;
      glGetIntegerv(name, &bound);
      state[text].push_back(bound);
    }
  }
  glActiveTexture(static_cast<GLenum>(active));
}

#undef PINOCCHIO_NAMED

}  // namespace gl_state

// The state of the context that is current. Before OpenGL 4.5 some of it does not exist: errors are dropped.
inline GlState read_gl_state() {
  GlState state;
  gl_state::read_numbers(state);
  gl_state::read_capabilities(state);
  gl_state::read_indexed(state);
  gl_state::read_units(state);
  for (const GLenum name : {GL_DEBUG_CALLBACK_FUNCTION, GL_DEBUG_CALLBACK_USER_PARAM}) {
    void* pointer = nullptr;
    if (glGetPointerv) glGetPointerv(name, &pointer);
    state["debug callback"].push_back(static_cast<double>(reinterpret_cast<std::uintptr_t>(pointer)));
  }
  while (gl_version() < 45 && glGetError() != GL_NO_ERROR) {
  }
  return state;
}

// The names of what differs.
inline std::vector<std::string> differences(const GlState& a, const GlState& b) {
  std::vector<std::string> names;
  for (const auto& [name, values] : a)
    if (b.at(name) != values) names.push_back(name);
  return names;
}

}  // namespace pinocchio
