// What frames are drawn with: opened when needed, kept from one picture to the next, shared by renderers.
#include "pinocchio/engine.h"

#include <dlfcn.h>

#include <string_view>
#include <thread>

#include "core/bsp/scene_trees.h"
#include "pinocchio/animation.h"
#include "tests/support/frames.h"
#include "tests/support/own_file.h"

namespace pinocchio {
namespace {

const View& view() {
  static const View kView{first_camera(load_or_die(source_path("scenes/cornell"))), {96, 64}};
  return kView;
}

Scene cornell() {
  return load_or_die(source_path("scenes/cornell"));
}

Settings alone() {
  Settings settings = by({{"mode", "raytrace"}});
  settings.threads = 2;
  return settings;
}

TEST(Engine, WithoutOpenGlThereMayBeAnyNumber) {
  const Scene scene = cornell();
  // None would find a context.
  Engine first({.backend = "none"}), second({.backend = "none"});
  const FrameResult wanted = first.render(scene, view(), alone()).value();
  EXPECT_EQ(first.gl_info(), nullptr);
  EXPECT_TRUE(same_pixels(second.render(scene, view(), alone()).value(), wanted));
  std::vector<FrameResult> pictures(2);
  {
    std::jthread a([&] { pictures[0] = first.render(scene, view(), alone()).value(); }),
        b([&] { pictures[1] = second.render(scene, view(), alone()).value(); });
  }
  for (const FrameResult& picture : pictures) EXPECT_TRUE(same_pixels(picture, wanted));
  EXPECT_THROW((void)first.render(scene, view()), std::runtime_error);  // the GPU's turn
  EXPECT_TRUE(same_pixels(first.render(scene, view(), alone()).value(), wanted));
}

TEST(Engine, KeepsTheTreeOfTheLastPicture) {
  Engine engine;
  Scene scene = cornell();
  const auto tree_after = [&](const Settings& settings, const View& of) {
    EXPECT_TRUE(engine.render(scene, of, settings));
    return engine.parts().last_tracer;
  };
  const std::shared_ptr<const Tracer> tree = tree_after(alone(), view());
  ASSERT_NE(tree, nullptr);
  EXPECT_EQ(tree_after(alone(), view()), tree);
  View other = view();
  other.size = {40, 30};
  EXPECT_EQ(tree_after(alone(), other), tree);
  scene.lights.front().position.x += 0.1f;
  EXPECT_EQ(tree_after(alone(), view()), tree);
  Settings another = alone();
  another.tree_leaf = 4;
  const std::shared_ptr<const Tracer> second = tree_after(another, view());
  EXPECT_NE(second, tree);
  EXPECT_EQ(tree_after(another, view()), second);
  scene = cornell();  // the same triangles, another mesh
  EXPECT_NE(tree_after(another, view()), second);
}

TEST(Engine, DrawsWhatARendererDraws) {
  Engine engine({.backend = "egl", .gl_debug = true});
  const Scene scene = cornell();
  for (const char* mode : {"hybrid", "raytrace"}) {
    Settings settings = by({{"mode", mode}});
    settings.threads = 2;
    settings.spp = 3;
    const FrameResult drawn = engine.render(scene, view(), settings).value();
    EXPECT_TRUE(same_pixels(
        drawn, draw_all(scene, {.settings = settings, .size = view().size}, {view().camera}).front()));
    EXPECT_EQ(drawn.settings.spp, 3);
  }
  EXPECT_NE(engine.gl_info(), nullptr);
  engine.throw_gl_complaints();
}

TEST(Engine, WhatCannotBeDrawnComesBackAsAnError) {
  Engine engine;
  const Scene scene = plate_over_floor();
  Settings settings = alone();
  settings.tiles = true;  // of what travels to the GPU
  const Expected<FrameResult> none = engine.render(scene, view(), settings);
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().message().find("tiles"), std::string::npos) << none.error().message();
  View nowhere = view();
  nowhere.camera.target = nowhere.camera.eye;
  const Expected<FrameResult> picture = engine.render(scene, nowhere, alone());
  ASSERT_FALSE(picture);
  EXPECT_NE(picture.error().message().find("same point"), std::string::npos) << picture.error().message();
}

// The CPU's own picture as a texture: OpenGL is opened for it.
TEST(Engine, ALonePictureMayBeWantedAsATexture) {
  Engine engine({.backend = "egl", .gl_debug = true});
  const Scene scene = cornell();
  const Settings settings = engine.resolve(scene, view().size, alone()).value();
  EXPECT_EQ(engine.gl_info(), nullptr);
  int frames = 0;
  Renderer renderer(engine, {[&](Frame& frame) {
                               EXPECT_EQ(frame.texture().size(), view().size);
                               EXPECT_NE(frame.texture_name(), 0u);
                               ++frames;
                             },
                             {}});
  renderer.submit({scene, Engine::prepare(scene, settings), settings, view()});
  renderer.drain();
  EXPECT_EQ(frames, 1);
  EXPECT_NE(engine.gl_info(), nullptr);
  engine.throw_gl_complaints();
}

TEST(Engine, ATreeForOneViewDrawsTheSamePicture) {
  Engine engine;
  const Scene scene = load_or_die(source_path("scenes/speedboat"));
  const View view{first_camera(scene), {160, 120}};
  Settings settings = engine.resolve(scene, view.size, alone()).value();
  settings.reuse = false;
  std::vector<Image<glm::vec4>> pictures;
  Renderer renderer(engine, {[&](Frame& frame) { frame.read_color(pictures.emplace_back()); }, {}});
  const auto any = Engine::prepare(scene, settings), only = Engine::prepare(scene, settings, nullptr, &view);
  for (const auto& tracer : {any, only}) renderer.submit({scene, tracer, settings, view});
  renderer.drain();
  ASSERT_EQ(pictures.size(), 2u);
  EXPECT_TRUE(same(pictures[0], pictures[1]));
  EXPECT_LT(only->trees().still->references.size(), any->trees().still->references.size());
}

// By its way to OpenGL's functions alone, as a window library gives it.
TEST(Engine, DrawsInTheCallersContext) {
  const auto context = gl::open_context({"egl", "", true});
  void* const egl = dlopen("libEGL.so.1", RTLD_NOW);
  ASSERT_NE(egl, nullptr);
  EngineOptions options;
  options.get_proc_address = reinterpret_cast<EngineOptions::GetProcAddress>(dlsym(egl, "eglGetProcAddress"));
  ASSERT_NE(options.get_proc_address, nullptr);
  const Scene scene = cornell();
  FrameResult drawn;
  {
    Engine engine(options);
    drawn = engine.render(scene, view()).value();
    ASSERT_NE(engine.gl_info(), nullptr);
    EXPECT_EQ(engine.gl_info()->renderer, context->info().renderer);
  }
  context->throw_complaints();
  EXPECT_TRUE(same_pixels(drawn, draw_all(scene, {.size = view().size}, {view().camera}).front()));
}

// As an OpenGL 3.3 without the extension has it.
void (*without_clip_control(const char* name))() {
  static const auto kFind = reinterpret_cast<EngineOptions::GetProcAddress>(
      dlsym(dlopen("libEGL.so.1", RTLD_NOW), "eglGetProcAddress"));
  return std::string_view(name).starts_with("glClipControl") ? nullptr : kFind(name);
}

TEST(Engine, ErrorsOfOpenGlAreOfThePublicFamily) {
  const auto context = gl::open_context({"egl", "", true});
  const Scene scene = cornell();
  Engine engine({.get_proc_address = without_clip_control});
  try {
    (void)engine.render(scene, view());
    FAIL() << "it was drawn without glClipControl";
  } catch (const NoOpenGlError& error) {
    EXPECT_NE(std::string(error.what()).find("lacks GL_ARB_clip_control"), std::string::npos) << error.what();
  }
  Engine too_large(*context);
  View wide = view();
  wide.size = {1 << 16, 1};
  EXPECT_THROW((void)too_large.render(scene, wide), OpenGlError);
  EXPECT_THROW((void)too_large.render(scene, wide), EnvironmentError);
}

using SharedEngineTest = FramesTest;
INSTANTIATE_TEST_SUITE_P(Backends, SharedEngineTest, kBackends, backend_name);

// Nobody could compile them a second time: they are gone.
TEST_P(SharedEngineTest, CompilesItsProgramsOnceForAllRenderers) {
  const std::filesystem::path folder = own_folder() / "shaders";
  std::filesystem::copy(source_path("shaders"), folder, std::filesystem::copy_options::recursive);
  setenv("PINOCCHIO_SHADERS", folder.c_str(), 1);
  const Scene scene = cornell();
  const FrameRequest request = this->request(scene, settings_for(scene), {48, 32});
  std::vector<Image<glm::vec4>> pictures;
  for (int i = 0; i < 3; ++i) {
    Renderer renderer(*engine_, {[&](Frame& frame) { frame.read_color(pictures.emplace_back()); }, {}});
    renderer.submit(request);
    renderer.drain();
    std::filesystem::remove_all(folder);
  }
  unsetenv("PINOCCHIO_SHADERS");
  ASSERT_EQ(pictures.size(), 3u);
  for (const Image<glm::vec4>& picture : pictures) EXPECT_TRUE(same(picture, pictures.front()));
}

TEST_P(SharedEngineTest, LetsGoOfAMeshThatNobodyHas) {
  std::weak_ptr<const GpuMesh> first;
  for (int i = 0; i < 3; ++i) {
    const Scene scene = cornell();
    draw({request(scene, settings_for(scene), {48, 32})}, Exchange::sync, [&](Frame& frame) {
      if (i == 0) first = frame.slot().mesh;
      EXPECT_LE(engine_->parts().meshes.size(), 1u);
    });
  }
  EXPECT_TRUE(first.expired());
}

// As the window edits materials: a new mesh whose geometry is the old one's. It is drawn as if sent whole.
TEST_P(SharedEngineTest, SendsNoGeometryAgainWhereMaterialsAloneDiffer) {
  Scene scene = cornell();
  const FrameRequest before = request(scene, settings_for(scene), {48, 32});
  {
    MeshEdit mesh(scene);
    for (Material& material : mesh->materials) material.diffuse *= 0.5f;
  }
  FrameRequest after = before, moved = before;
  after.scene = scene;
  MeshEdit(scene)->positions.front().x += 0.01f;
  moved.scene = scene;
  std::vector<std::shared_ptr<const GpuMesh>> meshes;
  std::vector<Image<glm::vec4>> pictures;
  const auto look = [&](Frame& frame) {
    meshes.push_back(frame.slot().mesh);
    frame.read_color(pictures.emplace_back());
  };
  draw({before, after, moved}, Exchange::sync, look);
  ASSERT_EQ(meshes.size(), 3u);
  EXPECT_NE(meshes[0], meshes[1]);
  EXPECT_FALSE(meshes[1]->is_alone());  // its geometry is that of the mesh before
  EXPECT_TRUE(meshes[2]->is_alone());
  EXPECT_FALSE(same(pictures[1], pictures[0]));
  engine_.emplace(context());  // that has no other mesh
  draw({after}, Exchange::sync, look);
  EXPECT_TRUE(same(pictures.back(), pictures[1]));
}

// Poses one after the other, with trees and buffers that are kept, and each by itself.
TEST_P(SharedEngineTest, DrawsPosesAsIfEachWereTheOnlyOne) {
  const Scene scene = load_or_die(source_path("scenes/windmill.glb"));
  const Settings settings = settings_for(scene);
  constexpr int kPoses = 6;
  for (const Exchange exchange : {Exchange::sync, Exchange::pipelined}) {
    std::vector<FrameRequest> requests;
    std::vector<FrameRecord> records;
    std::vector<Image<glm::vec4>> pictures;
    std::shared_ptr<const Tracer> tracer;
    std::size_t most = 0;
    {
      Renderer renderer(*engine_, {[&](Frame& frame) { frame.read_color(pictures.emplace_back()); },
                                   [&](const FrameRecord& record) { records.push_back(record); }});
      for (int i = 0; i < kPoses; ++i) {
        const Scene posed = at_time(scene, 0.1 * i).value();
        FrameRequest next = request(posed, settings, {48, 32});
        next.settings.exchange = exchange;
        next.tracer = tracer = Engine::prepare(posed, settings, nullptr, nullptr, tracer.get());
        renderer.submit(next);
        most = std::max(most, engine_->parts().meshes.size());
        requests.push_back(next);
        requests.back().tracer = nullptr;
        requests.back().scene = scene;  // the pose may go
      }
      renderer.drain();
    }
    EXPECT_FALSE(tracer->trees().moving.empty());
    EXPECT_LE(most, 4u);
    ASSERT_EQ(pictures.size(), std::size_t{kPoses});
    for (const FrameRecord& record : records) {
      EXPECT_GT(record[Stage::pose].ms(), 0.0);
      EXPECT_GT(record[Stage::trees].ms(), 0.0);
    }
    for (int i = 0; i < kPoses; ++i) {
      engine_.emplace(context());  // that has no other mesh
      const Scene posed = at_time(scene, 0.1 * i).value();
      FrameRequest alone = requests[static_cast<std::size_t>(i)];
      alone.scene = posed;
      alone.scene.mesh = std::make_shared<const Mesh>(MeshData(*posed.mesh));
      alone.tracer = Engine::prepare(alone.scene, settings);
      draw({alone}, Exchange::sync, [&](Frame& frame) {
        Image<glm::vec4> picture;
        frame.read_color(picture);
        EXPECT_TRUE(same(picture, pictures[static_cast<std::size_t>(i)])) << i;
      });
    }
  }
}

}  // namespace
}  // namespace pinocchio
