// A program with its own window and OpenGL context: GLFW opens the window, Pinocchio draws frames into
// textures, and the program shows them.
#include <pinocchio/engine.h>
#include <pinocchio/load.h>
#define GLFW_INCLUDE_GLEXT
#include <GLFW/glfw3.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

using namespace pinocchio;

int main(int argc, char** argv) {
  if (argc < 2) return std::puts("own_window SCENE [FRAMES]"), 2;
  const Expected<Scene> loaded = load_scene(argv[1]);
  if (!loaded) return std::puts(loaded.error().message().c_str()), 1;
  Scene scene = *loaded;
  const Camera camera = scene.cameras.empty() ? camera_for_whole_scene(scene) : scene.cameras.front();
  if (scene.lights.empty()) scene.lights.push_back(default_light(scene, camera));

  if (!glfwInit()) return std::puts("no display"), 3;
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  GLFWwindow* const window = glfwCreateWindow(800, 600, "a window of one's own", nullptr, nullptr);
  if (!window) return std::puts("no OpenGL 4.5"), 3;
  glfwMakeContextCurrent(window);
  const auto load = [](const char* name) { return glfwGetProcAddress(name); };
  const auto bind_framebuffer = reinterpret_cast<PFNGLBINDFRAMEBUFFERPROC>(load("glBindFramebuffer"));
  const auto create_framebuffers =
      reinterpret_cast<PFNGLCREATEFRAMEBUFFERSPROC>(load("glCreateFramebuffers"));
  const auto attach = reinterpret_cast<PFNGLNAMEDFRAMEBUFFERTEXTUREPROC>(load("glNamedFramebufferTexture"));
  const auto blit = reinterpret_cast<PFNGLBLITNAMEDFRAMEBUFFERPROC>(load("glBlitNamedFramebuffer"));

  {
    Engine engine({.get_proc_address = glfwGetProcAddress});
    const View view{.camera = camera, .size = {800, 600}};
    Settings wanted;
    wanted.exchange = Exchange::pipelined;
    const Expected<Settings> settings = engine.resolve(scene, view.size, wanted, false);
    if (!settings) return std::puts(settings.error().message().c_str()), 1;
    const auto tracer = Engine::prepare(scene, *settings);

    GLuint source = 0;
    create_framebuffers(1, &source);
    Renderer renderer(engine, {.frame = [&](Frame& frame) {
                        attach(source, GL_COLOR_ATTACHMENT0, frame.texture_name(), 0);
                        bind_framebuffer(GL_FRAMEBUFFER, 0);
                        blit(source, 0, 0, 0, 800, 600, 0, 600, 800, 0, GL_COLOR_BUFFER_BIT,
                             GL_NEAREST);  // row 0 is on top
                        glfwSwapBuffers(window);
                      }});
    const glm::vec3 home = scene.lights.front().position;
    const int frames = argc > 2 ? std::atoi(argv[2]) : 1 << 30;
    for (int n = 0; n < frames && !glfwWindowShouldClose(window); ++n) {
      scene.lights.front().position.x =
          home.x + 2.0f * std::sin(0.05f * static_cast<float>(n));  // copies no geometry
      renderer.submit({scene, tracer, *settings, view});
      glfwPollEvents();
    }
    renderer.drain();
  }  // the Engine ends before its context
  glfwTerminate();
}
