#include "tests/hybrid/engine/hostile_states.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <utility>

namespace pinocchio {
namespace {

GLuint new_buffer(GLenum target, GLsizeiptr bytes = 64) {
  GLuint name = 0;
  glGenBuffers(1, &name);
  glBindBuffer(target, name);
  const std::vector<std::uint8_t> data(static_cast<std::size_t>(bytes), 0x55);
  glBufferData(target, bytes, data.data(), GL_STATIC_DRAW);
  return name;
}

GLuint new_texture(GLenum target) {
  GLuint name = 0;
  glGenTextures(1, &name);
  glBindTexture(target, name);
  return name;
}

GLuint new_program(bool with_feedback = false) {
  const char* const vertex =
      "#version 400 core\n"
      "subroutine vec4 Place(); subroutine uniform Place place; out vec4 out_position;\n"
      "subroutine(Place) vec4 here() { return vec4(0); } subroutine(Place) vec4 there() { return vec4(1); }\n"
      "void main() { gl_Position = out_position = place(); }";
  const char* const fragment = "#version 400 core\nout vec4 color; void main() { color = vec4(1); }";
  const GLuint program = glCreateProgram();
  for (const auto& [stage, text] :
       {std::pair(GLenum{GL_VERTEX_SHADER}, vertex), std::pair(GLenum{GL_FRAGMENT_SHADER}, fragment)}) {
    const GLuint shader = glCreateShader(stage);
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    glAttachShader(program, shader);
  }
  const char* const varying = "out_position";
  if (with_feedback) glTransformFeedbackVaryings(program, 1, &varying, GL_INTERLEAVED_ATTRIBS);
  glLinkProgram(program);
  GLint linked = 0;
  glGetProgramiv(program, GL_LINK_STATUS, &linked);
  EXPECT_TRUE(linked);
  return program;
}

void bind_samplers() {
  GLint units = 0;
  glGetIntegerv(GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS, &units);
  GLuint sampler = 0;
  glGenSamplers(1, &sampler);
  glSamplerParameteri(sampler, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glSamplerParameteri(sampler, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  for (GLint unit = 0; unit < units; ++unit) glBindSampler(static_cast<GLuint>(unit), sampler);
}

void bind_textures() {
  GLint units = 0;
  glGetIntegerv(GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS, &units);
  for (GLint unit = 0; unit < units; ++unit) {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    for (const GLenum target : {GL_TEXTURE_1D, GL_TEXTURE_2D, GL_TEXTURE_3D, GL_TEXTURE_BUFFER,
                                GL_TEXTURE_CUBE_MAP, GL_TEXTURE_2D_ARRAY})
      new_texture(target);
  }
  glActiveTexture(GL_TEXTURE7);
}

void bind_other_buffers() {
  for (const GLenum target :
       {GL_ARRAY_BUFFER, GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER, GL_DRAW_INDIRECT_BUFFER,
        GL_DISPATCH_INDIRECT_BUFFER, GL_SHADER_STORAGE_BUFFER, GL_UNIFORM_BUFFER, GL_ATOMIC_COUNTER_BUFFER})
    new_buffer(target);
  for (const GLenum target : {GL_SHADER_STORAGE_BUFFER, GL_UNIFORM_BUFFER, GL_ATOMIC_COUNTER_BUFFER})
    glBindBufferBase(target, 0, new_buffer(target));
}

void begin_feedback() {
  glUseProgram(new_program(true));
  GLuint feedback = 0, array = 0;
  glGenTransformFeedbacks(1, &feedback);
  glBindTransformFeedback(GL_TRANSFORM_FEEDBACK, feedback);
  glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, new_buffer(GL_TRANSFORM_FEEDBACK_BUFFER, 1024));
  glGenVertexArrays(1, &array);
  glBindVertexArray(array);
  glBeginTransformFeedback(GL_TRIANGLES);
}

void bind_vertex_array() {
  GLuint name = 0;
  glGenVertexArrays(1, &name);
  glBindVertexArray(name);
  new_buffer(GL_ELEMENT_ARRAY_BUFFER);
  glEnableVertexAttribArray(3);
}

void store(const std::vector<std::pair<GLenum, GLint>>& values) {
  for (const auto& [name, value] : values) glPixelStorei(name, value);
}

}  // namespace

void use_program_with_subroutine() {
  glUseProgram(new_program());
  const GLuint second = 1;
  glUniformSubroutinesuiv(GL_VERTEX_SHADER, 1, &second);
}

void bind_framebuffers() {
  GLuint names[2];
  glGenFramebuffers(2, names);
  for (const auto& [target, name] :
       {std::pair(GLenum{GL_DRAW_FRAMEBUFFER}, names[0]), std::pair(GLenum{GL_READ_FRAMEBUFFER}, names[1])}) {
    GLuint texture = 0;
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 8, 8, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    glBindFramebuffer(target, name);
    glFramebufferTexture2D(target, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
  }
}

void enable_all(const std::vector<GLenum>& names) {
  for (const GLenum name : names) glEnable(name);
}

const std::vector<Hostile>& hostile_states() {
  static const std::vector<Hostile> kStates{
      {"nothing", [] {}},
      {"polygon_mode_lines", [] { glPolygonMode(GL_FRONT_AND_BACK, GL_LINE); }},
      {"color_mask", [] { glColorMask(GL_TRUE, GL_FALSE, GL_FALSE, GL_TRUE); }},
      {"color_mask_of_each",
       [] {
         for (GLuint i = 0; i < 8; ++i) glColorMaski(i, i % 2, 0, 1, 0);
       }},
      {"culling", [] { enable_all({GL_CULL_FACE}); }},
      {"culling_fronts",
       [] {
         enable_all({GL_CULL_FACE});
         glCullFace(GL_FRONT);
         glFrontFace(GL_CW);
       }},
      {"samplers", bind_samplers},
      {"scissor",
       [] {
         enable_all({GL_SCISSOR_TEST});
         glScissor(3, 5, 7, 2);
       }},
      {"unpack_rows",
       [] {
         store({{GL_UNPACK_ROW_LENGTH, 1000}, {GL_UNPACK_SKIP_ROWS, 1}, {GL_UNPACK_SKIP_PIXELS, 3}});
       }},
      {"unpack_bytes",
       [] {
         store({{GL_UNPACK_SWAP_BYTES, 1}, {GL_UNPACK_ALIGNMENT, 8}, {GL_UNPACK_LSB_FIRST, 1}});
       }},
      {"unpack_images",
       [] {
         store({{GL_UNPACK_IMAGE_HEIGHT, 9}, {GL_UNPACK_SKIP_IMAGES, 2}});
       }},
      {"pack_rows",
       [] {
         store({{GL_PACK_ROW_LENGTH, 200}, {GL_PACK_SKIP_ROWS, 1}, {GL_PACK_SKIP_PIXELS, 3}});
       }},
      {"pack_bytes",
       [] {
         store({{GL_PACK_SWAP_BYTES, 1}, {GL_PACK_ALIGNMENT, 8}, {GL_PACK_LSB_FIRST, 1}});
       }},
      {"pack_images",
       [] {
         store({{GL_PACK_IMAGE_HEIGHT, 9}, {GL_PACK_SKIP_IMAGES, 2}});
       }},
      {"clamped_reads", [] { glClampColor(GL_CLAMP_READ_COLOR, GL_TRUE); }},
      {"depth_mask", [] { glDepthMask(GL_FALSE); }},
      {"depth_func",
       [] {
         enable_all({GL_DEPTH_TEST});
         glDepthFunc(GL_NEVER);
       }},
      {"depth_clamp_and_range",
       [] {
         enable_all({GL_DEPTH_CLAMP});
         glDepthRange(1.0, 0.25);
       }},
      {"ranges_and_viewports_of_each",
       [] {
         for (GLuint i = 0; i < 4; ++i) {
           glDepthRangeIndexed(i, 0.5, 0.25 * i);
           glViewportIndexedf(i, 0.5f, 1.25f, 3.0f, 4.0f + static_cast<float>(i));
           glScissorIndexed(i, 1, 2, 3, 4);
           glEnablei(GL_SCISSOR_TEST, i);
         }
       },
       41},
      {"blend_max",
       [] {
         enable_all({GL_BLEND});
         glBlendEquation(GL_MAX);
         glBlendFunc(GL_ZERO, GL_ONE_MINUS_SRC_ALPHA);
       }},
      {"blend_of_each",
       [] {
         for (GLuint i = 0; i < 8; ++i) {
           if (i % 2 == 0) glEnablei(GL_BLEND, i);
           glBlendFunci(i, GL_ZERO, GL_ZERO);
           glBlendEquationi(i, GL_MIN);
         }
       },
       40},
      {"polygon_offset",
       [] {
         enable_all({GL_POLYGON_OFFSET_FILL, GL_POLYGON_OFFSET_LINE, GL_POLYGON_OFFSET_POINT});
         if (glPolygonOffsetClampEXT)
           glPolygonOffsetClampEXT(40.0f, 1000.0f, 0.5f);
         else
           glPolygonOffset(40.0f, 1000.0f);
       }},
      {"logic_op",
       [] {
         enable_all({GL_COLOR_LOGIC_OP});
         glLogicOp(GL_XOR);
       }},
      {"unpack_buffer", [] { new_buffer(GL_PIXEL_UNPACK_BUFFER); }},
      {"pack_buffer", [] { new_buffer(GL_PIXEL_PACK_BUFFER); }},
      {"query_buffer", [] { new_buffer(GL_QUERY_BUFFER); }, 44},
      {"other_buffers", bind_other_buffers, 43},
      {"srgb", [] { enable_all({GL_FRAMEBUFFER_SRGB}); }},
      {"clip_control", [] { glClipControl(GL_UPPER_LEFT, GL_NEGATIVE_ONE_TO_ONE); }},
      {"clip_distances",
       [] {
         for (GLenum i = 0; i < 8; ++i) glEnable(GL_CLIP_DISTANCE0 + i);
       }},
      {"rasterizer_discard", [] { enable_all({GL_RASTERIZER_DISCARD}); }},
      {"primitive_restart",
       [] {
         enable_all({GL_PRIMITIVE_RESTART});
         glPrimitiveRestartIndex(2);
       }},
      {"primitive_restart_fixed", [] { enable_all({GL_PRIMITIVE_RESTART_FIXED_INDEX}); }, 43},
      {"sample_mask",
       [] {
         enable_all({GL_SAMPLE_MASK, GL_SAMPLE_COVERAGE, GL_SAMPLE_SHADING});
         glSampleMaski(0, 0);
         glSampleCoverage(0.0f, GL_TRUE);
         glMinSampleShading(1.0f);
       },
       40},
      {"alpha_to_coverage",
       [] {
         enable_all({GL_SAMPLE_ALPHA_TO_COVERAGE, GL_SAMPLE_ALPHA_TO_ONE});
         glDisable(GL_MULTISAMPLE);
       }},
      {"stencil",
       [] {
         enable_all({GL_STENCIL_TEST});
         glStencilFunc(GL_NEVER, 3, 0x0f);
         glStencilMask(0);
       }},
      {"no_dither", [] { glDisable(GL_DITHER); }},
      {"provoking_vertex", [] { glProvokingVertex(GL_FIRST_VERTEX_CONVENTION); }},
      {"lines_and_points",
       [] {
         enable_all({GL_LINE_SMOOTH, GL_POLYGON_SMOOTH, GL_PROGRAM_POINT_SIZE});
         glPointSize(9.0f);
         glLineWidth(1.0f);
       }},
      {"viewport", [] { glViewport(9, 9, 3, 3); }},
      {"textures", bind_textures},
      {"program_with_subroutine", use_program_with_subroutine, 40},
      {"pipeline",
       [] {
         GLuint name = 0;
         glGenProgramPipelines(1, &name);
         glBindProgramPipeline(name);
       },
       41},
      {"transform_feedback", begin_feedback, 40},
      {"vertex_array", bind_vertex_array},
      {"framebuffers", bind_framebuffers},
      {"clear_values",
       [] {
         glClearColor(0.25f, 0.5f, 0.75f, 1.0f);
         glClearDepth(0.5);
         glClearStencil(3);
       }},
      {"an_error_of_its_own", [] { glEnable(0xdead); }},
  };
  return kStates;
}

}  // namespace pinocchio
