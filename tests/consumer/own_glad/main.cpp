// own_glad SCENE: the table of functions that this program has is its own, before and after we draw.
#include <glad/gl.h>
#include <pinocchio/engine.h>
#include <pinocchio/load.h>

#include <cstdio>
#include <string>

namespace {

int clears = 0, lookups = 0;

void GLAD_API_PTR count_clear(GLbitfield) {
  ++clears;
}
const GLubyte* GLAD_API_PTR version_text(GLenum) {
  return reinterpret_cast<const GLubyte*>("3.3 of the program's own");
}
const GLubyte* GLAD_API_PTR extension_text(GLenum, GLuint) {
  return reinterpret_cast<const GLubyte*>("GL_none");
}
void GLAD_API_PTR count_of_extensions(GLenum, GLint* value) {
  *value = 1;
}

// An OpenGL of the program's own, whose glClear counts.
GLADapiproc look_up(const char* name) {
  ++lookups;
  const std::string text = name;
  if (text == "glGetString") return reinterpret_cast<GLADapiproc>(version_text);
  if (text == "glGetIntegerv") return reinterpret_cast<GLADapiproc>(count_of_extensions);
  if (text == "glGetStringi") return reinterpret_cast<GLADapiproc>(extension_text);
  return reinterpret_cast<GLADapiproc>(count_clear);
}

bool fails(const char* what) {
  std::printf("own_glad: %s\n", what);
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return std::puts("own_glad SCENE"), 2;
  if (gladLoadGL(look_up) == 0 || lookups == 0) return fails("its own glad does not load");
  const auto own_clear = glad_glClear;
  const auto scene = pinocchio::load_scene(argv[1]);
  if (!scene) return std::puts(scene.error().message().c_str()), 1;
  const int lookups_before = lookups;
  pinocchio::Engine engine;
  const auto camera = scene->cameras.empty() ? camera_for_whole_scene(*scene) : scene->cameras.front();
  if (!engine.render(*scene, {.camera = camera, .size = {64, 48}})) return fails("nothing is drawn");
  if (lookups != lookups_before) return fails("Pinocchio asked the program's OpenGL");
  if (glad_glClear != own_clear) return fails("Pinocchio changed the program's table");
  if (clears != 0) return fails("Pinocchio drew by the program's table");
  glClear(0);
  return clears == 1 ? 0 : fails("the program's glClear is not its own");
}
