#include "gl/context/state.h"

#include <array>
#include <string>
#include <utility>

#include "gl/context/context.h"
#include "gl/context/error.h"
#include "gl/context/handle.h"

namespace pinocchio::gl {
namespace {

int version() {
  const PinocchioGladGLContext& f = current->functions;
  return f.VERSION_4_4 ? 44 : f.VERSION_4_3 ? 43 : f.VERSION_4_1 ? 41 : f.VERSION_4_0 ? 40 : 33;
}

// Enabled or not: all are off while we draw, but for those that RasterState names. Draw buffers have GL_BLEND
// and viewports GL_SCISSOR_TEST one by one: ours is the first, but drivers look at all.
struct Capability {
  GLenum name;
  int since = 33;          // OpenGL's version
  GLenum count = GL_NONE;  // how many there are of it
  int several_since = 33;  // before, there is one for all
};
constexpr Capability kCapabilities[] = {{GL_BLEND, 33, GL_MAX_DRAW_BUFFERS},
                                        {GL_SCISSOR_TEST, 33, GL_MAX_VIEWPORTS, 41},
                                        {GL_DEPTH_TEST},
                                        {GL_FRAMEBUFFER_SRGB},
                                        {GL_COLOR_LOGIC_OP},
                                        {GL_CULL_FACE},
                                        {GL_DEPTH_CLAMP},
                                        {GL_DITHER},
                                        {GL_POLYGON_OFFSET_FILL},
                                        {GL_POLYGON_SMOOTH},
                                        {GL_PRIMITIVE_RESTART},
                                        {GL_PRIMITIVE_RESTART_FIXED_INDEX, 43},
                                        {GL_RASTERIZER_DISCARD},
                                        {GL_SAMPLE_ALPHA_TO_COVERAGE},
                                        {GL_SAMPLE_ALPHA_TO_ONE},
                                        {GL_SAMPLE_COVERAGE},
                                        {GL_SAMPLE_MASK},
                                        {GL_SAMPLE_SHADING, 40},
                                        {GL_STENCIL_TEST},
                                        {GL_CLIP_DISTANCE0},
                                        {GL_CLIP_DISTANCE1},
                                        {GL_CLIP_DISTANCE2},
                                        {GL_CLIP_DISTANCE3},
                                        {GL_CLIP_DISTANCE4},
                                        {GL_CLIP_DISTANCE5},
                                        {GL_CLIP_DISTANCE6},
                                        {GL_CLIP_DISTANCE7}};

struct PixelStore {
  GLenum name;
  GLint value;  // ours
};
constexpr PixelStore kPixelStore[] = {
    {GL_PACK_ALIGNMENT, 1},     {GL_PACK_ROW_LENGTH, 0},     {GL_PACK_IMAGE_HEIGHT, 0},
    {GL_PACK_SKIP_ROWS, 0},     {GL_PACK_SKIP_PIXELS, 0},    {GL_PACK_SKIP_IMAGES, 0},
    {GL_PACK_SWAP_BYTES, 0},    {GL_PACK_LSB_FIRST, 0},      {GL_UNPACK_ALIGNMENT, 1},
    {GL_UNPACK_ROW_LENGTH, 0},  {GL_UNPACK_IMAGE_HEIGHT, 0}, {GL_UNPACK_SKIP_ROWS, 0},
    {GL_UNPACK_SKIP_PIXELS, 0}, {GL_UNPACK_SKIP_IMAGES, 0},  {GL_UNPACK_SWAP_BYTES, 0},
    {GL_UNPACK_LSB_FIRST, 0}};

// What is bound outside of vertex arrays, and what is one number. The order is that of restoring.
struct Integer {
  GLenum name;
  void (*set)(GLint value);
  int since = 33;
  bool unbound = false;  // our calls find nothing bound here
};
constexpr Integer kIntegers[] = {
    {GL_ARRAY_BUFFER_BINDING, [](GLint name) { glBindBuffer(GL_ARRAY_BUFFER, name); }, 33, true},
    {GL_COPY_WRITE_BUFFER_BINDING, [](GLint name) { glBindBuffer(GL_COPY_WRITE_BUFFER, name); }, 33, true},
    {GL_PIXEL_PACK_BUFFER_BINDING, [](GLint name) { glBindBuffer(GL_PIXEL_PACK_BUFFER, name); }, 33, true},
    {GL_PIXEL_UNPACK_BUFFER_BINDING, [](GLint name) { glBindBuffer(GL_PIXEL_UNPACK_BUFFER, name); }, 33,
     true},
    {GL_QUERY_BUFFER_BINDING, [](GLint name) { glBindBuffer(GL_QUERY_BUFFER, name); }, 44, true},
    {GL_DRAW_FRAMEBUFFER_BINDING, [](GLint name) { glBindFramebuffer(GL_DRAW_FRAMEBUFFER, name); }},
    {GL_READ_FRAMEBUFFER_BINDING, [](GLint name) { glBindFramebuffer(GL_READ_FRAMEBUFFER, name); }},
    {GL_VERTEX_ARRAY_BINDING, [](GLint name) { glBindVertexArray(name); }},
    {GL_POLYGON_MODE, [](GLint mode) { glPolygonMode(GL_FRONT_AND_BACK, mode); }},
    {GL_FRONT_FACE, [](GLint turn) { glFrontFace(turn); }},
    {GL_CULL_FACE_MODE, [](GLint side) { glCullFace(side); }},
    {GL_CLAMP_READ_COLOR, [](GLint clamp) { glClampColor(GL_CLAMP_READ_COLOR, clamp); }},
    {GL_DEPTH_FUNC, [](GLint function) { glDepthFunc(function); }},
    {GL_DEPTH_WRITEMASK, [](GLint on) { glDepthMask(on != 0); }}};

void set_capability(GLenum name, bool on) {
  on ? glEnable(name) : glDisable(name);
}
void set_scissor(const glm::ivec4& box) {
  version() < 41 ? glScissor(box.x, box.y, box.z, box.w) : glScissorIndexed(0, box.x, box.y, box.z, box.w);
}
void set_viewport(const glm::vec4& box) {
  if (version() < 41)
    glViewport(box.x, box.y, box.z, box.w);
  else
    glViewportIndexedf(0, box.x, box.y, box.z, box.w);
}
void set_polygon_offset(float factor, float units, float clamp) {
  if (glPolygonOffsetClampEXT)
    glPolygonOffsetClampEXT(factor, units, clamp);
  else
    glPolygonOffset(factor, units);
}
void set_depth_range(double at_near, double at_far) {
  version() < 41 ? glDepthRange(at_near, at_far) : glDepthRangeIndexed(0, at_near, at_far);
}

GLint integer(GLenum name) {
  std::array<GLint, 4> values{};  // some drivers have two polygon modes
  glGetIntegerv(name, values.data());
  return values[0];
}
float real(GLenum name) {
  GLfloat value = 0.0f;
  glGetFloatv(name, &value);
  return value;
}

struct DeleteQueryName {
  void operator()(GLuint name) const { glDeleteQueries(1, &name); }
};

// Queries and conditions cannot be suspended, and would count or drop what we draw.
void refuse_queries() {
  struct Counter {
    GLenum target;
    const char* name;
    int since = 33;
  };
  constexpr Counter kCounters[] = {
      {GL_SAMPLES_PASSED, "GL_SAMPLES_PASSED"},
      {GL_ANY_SAMPLES_PASSED, "GL_ANY_SAMPLES_PASSED"},
      {GL_ANY_SAMPLES_PASSED_CONSERVATIVE, "GL_ANY_SAMPLES_PASSED_CONSERVATIVE", 43},
      {GL_PRIMITIVES_GENERATED, "GL_PRIMITIVES_GENERATED"}};
  for (const Counter& counter : kCounters) {
    GLint query = 0;
    if (version() >= counter.since) glGetQueryiv(counter.target, GL_CURRENT_QUERY, &query);
    if (query != 0)
      throw Error(std::string("a query (") + counter.name +
                  ") is active in the caller's context and would count what is drawn; end it first");
  }
  // OpenGL does not tell whether there is a condition, but refuses a second one.
  GLuint name = 0;
  glGenQueries(1, &name);
  if (name == 0) return;
  const Handle<DeleteQueryName> query(name);
  glBeginQuery(GL_ANY_SAMPLES_PASSED, name);
  glEndQuery(GL_ANY_SAMPLES_PASSED);
  clear_errors();
  glBeginConditionalRender(name, GL_QUERY_NO_WAIT);
  const GLenum error = glGetError();
  if (error == GL_INVALID_OPERATION)
    throw Error(
        "conditional rendering (glBeginConditionalRender) is active in the caller's context; end it first");
  if (error == GL_NO_ERROR) glEndConditionalRender();
}

}  // namespace

void set_viewport(glm::ivec2 lo, glm::ivec2 size) {
  set_viewport(glm::vec4(lo, size));
}

void set_raster_state(const RasterState& state) {
  const auto is_on = [&](GLenum name) {
    return name == GL_DEPTH_TEST         ? state.depth
           : name == GL_FRAMEBUFFER_SRGB ? state.srgb
           : name == GL_SCISSOR_TEST     ? state.scissor
           : name == GL_CULL_FACE        ? state.fronts_only
                                         : false;
  };
  for (const Capability& c : kCapabilities)
    if (c.since <= version()) set_capability(c.name, is_on(c.name));
  if (state.scissor) set_scissor(state.scissor_box);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  glFrontFace(GL_CW);  // row 0 of a picture is its top
  glCullFace(GL_BACK);
  set_polygon_offset(0.0f, 0.0f, 0.0f);  // llvmpipe adds the offset, enabled or not
  glColorMaski(0, GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_GREATER);
  set_depth_range(0.0, 1.0);
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
}

void set_pixel_store() {
  for (const PixelStore& store : kPixelStore) glPixelStorei(store.name, store.value);
  glClampColor(GL_CLAMP_READ_COLOR, GL_FIXED_ONLY);
}

void SavedState::save() {
  clear_errors();  // the caller's errors would be taken for ours
  refuse_queries();
  restorers_.clear();
  read();
  for (const Integer& i : kIntegers)
    if (i.unbound && i.since <= version()) i.set(0);
  if (version() >= 40 && integer(GL_TRANSFORM_FEEDBACK_ACTIVE) && !integer(GL_TRANSFORM_FEEDBACK_PAUSED)) {
    glPauseTransformFeedback();
    restorers_.emplace_back([] { glResumeTransformFeedback(); });
  }
  glActiveTexture(GL_TEXTURE0);
  set_pixel_store();
}

// The order is that of restoring.
void SavedState::read() {
  const auto later = [this](auto restorer) { restorers_.emplace_back(std::move(restorer)); };
  for (const Capability& c : kCapabilities) {
    if (c.since > version()) continue;
    const bool is_one = c.count == GL_NONE || c.several_since > version();
    if (is_one) later([name = c.name, on = glIsEnabled(c.name)] { set_capability(name, on); });
    for (GLint i = 0; !is_one && i < integer(c.count); ++i)
      later([name = c.name, i, on = glIsEnabledi(c.name, i)] {
        on ? glEnablei(name, i) : glDisablei(name, i);
      });
  }
  for (const PixelStore& s : kPixelStore)
    later([name = s.name, value = integer(s.name)] { glPixelStorei(name, value); });
  const GLint active = integer(GL_ACTIVE_TEXTURE);
  for (GLuint unit = 0; unit < kTextureUnits; ++unit) {
    glActiveTexture(GL_TEXTURE0 + unit);
    later([unit, picture = integer(GL_TEXTURE_BINDING_2D), buffer = integer(GL_TEXTURE_BINDING_BUFFER),
           sampler = integer(GL_SAMPLER_BINDING)] {
      glActiveTexture(GL_TEXTURE0 + unit);
      glBindTexture(GL_TEXTURE_2D, picture);
      glBindTexture(GL_TEXTURE_BUFFER, buffer);
      glBindSampler(unit, sampler);
    });
  }
  later([active] { glActiveTexture(active); });
  for (const Integer& i : kIntegers)
    if (i.since <= version()) later([set = i.set, value = integer(i.name)] { set(value); });
  later([factor = real(GL_POLYGON_OFFSET_FACTOR), units = real(GL_POLYGON_OFFSET_UNITS),
         clamp = glPolygonOffsetClampEXT ? real(GL_POLYGON_OFFSET_CLAMP_EXT) : 0.0f] {
    set_polygon_offset(factor, units, clamp);
  });
  later([origin = integer(GL_CLIP_ORIGIN), depth = integer(GL_CLIP_DEPTH_MODE)] {
    glClipControl(origin, depth);
  });
  std::array<GLboolean, 4> mask{};
  glGetBooleani_v(GL_COLOR_WRITEMASK, 0, mask.data());
  later([mask] { glColorMaski(0, mask[0], mask[1], mask[2], mask[3]); });
  glm::vec4 viewport(0.0f);
  std::array<GLdouble, 2> range{};
  if (version() < 41) {
    glGetFloatv(GL_VIEWPORT, &viewport.x);
    glGetDoublev(GL_DEPTH_RANGE, range.data());
  } else {
    glGetFloati_v(GL_VIEWPORT, 0, &viewport.x);
    glGetDoublei_v(GL_DEPTH_RANGE, 0, range.data());
  }
  later([viewport] { set_viewport(viewport); });
  later([range] { set_depth_range(range[0], range[1]); });
  read_program();
}

// The program, and the subroutines that it was told to call: OpenGL forgets those when another program is
// used.
void SavedState::read_program() {
  const GLint program = integer(GL_CURRENT_PROGRAM);
  restorers_.emplace_back([program] { glUseProgram(program); });
  if (program == 0 || version() < 40) return;
  for (const GLenum stage : {GL_VERTEX_SHADER, GL_TESS_CONTROL_SHADER, GL_TESS_EVALUATION_SHADER,
                             GL_GEOMETRY_SHADER, GL_FRAGMENT_SHADER}) {
    GLint count = 0;
    glGetProgramStageiv(program, stage, GL_ACTIVE_SUBROUTINE_UNIFORM_LOCATIONS, &count);
    if (count <= 0) continue;
    std::vector<GLuint> chosen(count);
    for (GLint i = 0; i < count; ++i) glGetUniformSubroutineuiv(stage, i, &chosen[i]);
    restorers_.emplace_back([stage, count, chosen] { glUniformSubroutinesuiv(stage, count, chosen.data()); });
  }
  clear_errors();  // a stage that the program does not have is one
}

void SavedState::restore() noexcept {
  for (const std::function<void()>& restorer : restorers_) restorer();
  restorers_.clear();
}

}  // namespace pinocchio::gl
