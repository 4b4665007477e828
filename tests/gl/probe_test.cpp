#include "gl/open/probe.h"

#include "core/base/clock.h"
#include "gl/context/error.h"
#include "tests/support/gl_test.h"

namespace pinocchio {
namespace {

using ProbeTest = GlTest;
INSTANTIATE_TEST_SUITE_P(Backends, ProbeTest, kBackends, backend_name);

TEST_P(ProbeTest, ADriverThatDrawsPassesInLittleTime) {
  const double begin_s = now_s();
  EXPECT_NO_THROW(gl::probe(context().info()));
  const double probe_s = now_s() - begin_s;
  std::printf("  the probe takes %.1f ms\n", 1e3 * probe_s);
  EXPECT_LT(probe_s, 1.0);
}

// The driver's functions, but for one that does something else.
GLenum real_format = 0, given_format = 0;
PFNGLTEXIMAGE2DPROC real_tex_image = nullptr;

void tex_image(GLenum target, GLint level, GLint format, GLsizei width, GLsizei height, GLint border,
               GLenum channels, GLenum type, const void* pixels) {
  const GLint taken = format == static_cast<GLint>(real_format) ? static_cast<GLint>(given_format) : format;
  real_tex_image(target, level, taken, width, height, border, channels, type, pixels);
}

TEST_P(ProbeTest, ADriverThatDrawsSomethingElseIsRefused) {
  PinocchioGladGLContext& functions = gl::current->functions;
  const PinocchioGladGLContext real = functions;
  real_tex_image = functions.TexImage2D;
  const auto expect_refused = [&](const char* what) {
    try {
      gl::probe(context().info());
      ADD_FAILURE() << what << " is not seen";
    } catch (const gl::Error& error) {
      EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(context().info().renderer), std::string::npos) << error.what();
    }
    functions = real;
    EXPECT_NO_THROW(gl::probe(context().info())) << "after: " << what;
  };
  functions.DrawElements = [](GLenum, GLsizei, GLenum, const void*) {};
  expect_refused("draws nothing");
  functions.ClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
  functions.ClipControl = [](GLenum, GLenum) {};
  expect_refused("draws other triangles than the nearest");
  functions.TexImage2D = tex_image;
  real_format = GL_DEPTH_COMPONENT32F;
  given_format = GL_DEPTH_COMPONENT16;
  expect_refused("draws nothing");
  functions.TexImage2D = tex_image;
  real_format = GL_RGBA16F;
  given_format = GL_RGBA8;
  expect_refused("target of half floats");
}

}  // namespace
}  // namespace pinocchio
