// Every string that the window shows, in a list that a person can read: tests/view/shown_texts.txt. To write
// it anew: PINOCCHIO_WRITE_TEXTS=1.
#include <gtest/gtest.h>
#include <imgui.h>

#include <array>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <set>

#include "app/window/overlay/parts.h"
#include "core/scene/gltf/material_from_surface.h"
#include "hybrid/settings/resolve.h"
#include "hybrid/settings/scene_stats.h"
#include "pinocchio/load.h"
#include "tests/support/own_file.h"

namespace pinocchio::app {
namespace {

constexpr const char* kList = PINOCCHIO_SOURCE_DIR "/tests/view/shown_texts.txt";

// A model in which everything has something to show.
Model full_model() {
  Model model;
  model.scene = load_scene(PINOCCHIO_SOURCE_DIR "/scenes/cornell").value();
  model.scene.animation = load_scene(PINOCCHIO_SOURCE_DIR "/scenes/windmill").value().animation;
  model.scene.variants = {"night"};
  model.scene.source = "scene.gltf";  // texts name no folder of a machine
  model.save.folder = "pictures";
  model.stats = analyze(model.scene);
  model.settings.overlay = true;
  model.settings.split = Split::heat_map;
  model.settings.settings.depth = 3;
  model.drawn = resolve(wanted_settings(model.settings), model.stats, {{320, 240}, false, false}).value();
  for (std::size_t i = 0; i < kPanels.size(); ++i) model.panels[static_cast<Panel>(i)] = true;
  FrameRecord record;
  for (std::size_t i = 0; i < kStageNames.size(); ++i) record.stages[i] = {0.01, 0.02};
  record.frame = {0.0, 0.05};
  record.bytes.fill(1000);
  record.rays = {1000, 1000, 1000, 1000};
  record.age_frames = 2;
  for (int i = 0; i < 3; ++i) model.history.add(record);
  model.loading = {"reading scene.gltf", 1.0, 0.5};
  model.legend = "a channel's legend";
  model.comparison = "left: as drawn   right: reference";
  model.recent = {"scene.gltf"};
  model.files.folder = "scenes";
  model.files.entries = {{"folder", true}, {"scene.gltf", false}};
  PixelReport& pixel = model.pixel.emplace();
  pixel.triangle = 1;
  pixel.lights = {{"lamp", true, {}}, {"lamp", false, {}}};
  model.pixel_error = 0.0;
  model.histogram.emplace(std::vector<LightHistogram::Sample>{{0x3c00, 0x3c00}, {0, 0}});
  model.renderer = "renderer";
  model.given_up = "shadows";
  model.leaving.emplace();
  model.parts = {.bytes = 1000, .extensions = {"EXT"}, .warnings = {"warning"}, .hidden = {}};
  model.parts.hidden.assign(model.scene.mesh->materials.size(), false);
  model.playback.all = model.scene.animation;
  return model;
}

// What ImGui was given to show.
std::string logged(Model& model) {
  const std::filesystem::path log = own_folder() / "log.txt";
  std::filesystem::create_directories(log.parent_path());
  std::filesystem::remove(log);
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.DisplaySize = ImVec2(1600.0f, 6000.0f);  // so that nothing is scrolled away
  unsigned char* pixels = nullptr;
  int width = 0, height = 0;
  io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
  using Draw = void (*)(Model&, float);
  constexpr std::array<Draw, 12> kInPanels{
      draw_help,      draw_figures, draw_controls, draw_all_settings, draw_light_controls, draw_camera,
      draw_materials, draw_pixel,   draw_timeline, draw_files,        draw_scene,          draw_save};
  constexpr std::array<Draw, 6> kOfTheirOwn{draw_status_line, draw_playback, draw_messages,
                                            draw_loading,     draw_caption,  draw_question};
  for (int frame = 0; frame < 4; ++frame) {
    io.DeltaTime = 0.02f;
    ImGui::NewFrame();
    const auto begin_log = [&] {  // ends with the window
      if (frame == 3) ImGui::LogToFile(9, log.c_str());
    };
    for (std::size_t i = 0; i < kInPanels.size(); ++i) {
      ImGui::SetNextWindowSize(ImVec2(600.0f, 5000.0f));
      begin_log();
      ImGui::Begin(kPanels[i].title);
      kInPanels[i](model, 1.0f);
      ImGui::End();
    }
    for (const Draw draw : kOfTheirOwn) {
      begin_log();
      draw(model, 1.0f);
    }
    ImGui::EndFrame();
  }
  ImGui::DestroyContext();
  std::ifstream in(log);
  return {std::istreambuf_iterator<char>(in), {}};
}

// The same line by line, numbers as '#'.
std::set<std::string> shown(Model& model) {
  const std::string all = logged(model);
  std::set<std::string> texts;
  std::regex number("-?[0-9]+([.][0-9]+)?"), edge("[\\[\\]]|\\| |   +|\n");
  for (std::sregex_token_iterator at(all.begin(), all.end(), edge, -1), end; at != end; ++at) {
    std::string text = std::regex_replace(at->str(), number, "#");
    const std::size_t first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
    if (first != std::string::npos && text.find_first_not_of(" #.,%x-") != std::string::npos)
      texts.insert(text.substr(first, last - first + 1));
  }
  for (const PanelInfo& panel : kPanels) {
    texts.insert(panel.title);
    texts.insert(panel.what);
  }
  return texts;
}

TEST(Texts, EveryStringIsInTheList) {
  Model model = full_model();
  const std::set<std::string> texts = shown(model);
  EXPECT_GT(texts.size(), 150u);
  if (std::getenv("PINOCCHIO_WRITE_TEXTS")) {
    std::ofstream out(kList);
    for (const std::string& text : texts) out << text << '\n';
  }
  std::ifstream in(kList);
  std::set<std::string> listed;
  for (std::string line; std::getline(in, line);) listed.insert(line);
  EXPECT_EQ(texts, listed);
}

// The panel Scene, in a file that has everything.
TEST(Texts, FactsAboutTheFileAreItsOwn) {
  Model model = full_model();
  const Mesh& mesh = *model.scene.mesh;
  model.scene.variants = {"day", "night"};
  model.parts.bytes = 1234567;
  model.parts.extensions = {"KHR_texture_transform", "KHR_materials_clearcoat"};
  model.parts.warnings = {"a morph target without positions"};
  const std::string all = logged(model);
  const auto has_row = [&all](const std::string& name, const std::string& value) {
    return std::regex_search(all, std::regex("\n" + name + "\\[[^\\]]*\\] " + value + "\n"));
  };
  for (const auto& [name, value] : std::vector<std::pair<std::string, std::string>>{
           {"file", "scene[.]gltf"},
           {"size", "1[.]23 MB"},
           {"triangles", std::to_string(mesh.triangles.size())},
           {"vertices", std::to_string(mesh.positions.size())},
           {"materials", std::to_string(mesh.materials.size())},
           {"variants", "2"},
           {"textures", "0"},
           {"lights", "1"},
           {"cameras", std::to_string(model.scene.cameras.size())},
           {"animations", "1, 4[.]00 s"}})
    EXPECT_TRUE(has_row(name, value)) << name << " " << value << " in\n" << all;
  for (const char* text :
       {"KHR_texture_transform", "KHR_materials_clearcoat", "left out: a morph target without positions"})
    EXPECT_NE(all.find(text), std::string::npos) << text;
}

// Materials have the words of the model that their file gives them.
TEST(Texts, MaterialsHaveTheWordsOfTheirFile) {
  const auto words = [](Material material) {
    Model model = full_model();
    auto mesh = std::make_shared<Mesh>(*model.scene.mesh);
    mesh->materials[0] = std::move(material);
    model.scene.mesh = std::move(mesh);
    model.material = 0;
    return shown(model);
  };
  const std::vector<std::string> of_gltf{"base colour",  "metallic",   "roughness",    "emitted",
                                         "transmission", "clear coat", "its roughness"},
      of_phong{"specular", "shininess"};
  GltfSurface surface;
  surface.layers.coat = 0.5f;
  const std::set<std::string> gltf = words(material_from_surface(surface, Shading::from_file)),
                              phong = words(material_from_surface(surface, Shading::phong));
  for (const std::string& word : of_gltf) {
    EXPECT_TRUE(gltf.contains(word)) << word;
    EXPECT_FALSE(phong.contains(word)) << word;
  }
  for (const std::string& word : of_phong) {
    EXPECT_FALSE(gltf.contains(word)) << word;
    EXPECT_TRUE(phong.contains(word)) << word;
  }
}

// No frame takes less time than can be measured.
TEST(Texts, NoFrameTakesNoTime) {
  Model model = full_model();
  model.loading = {};
  model.idle = true;
  model.history.clear();
  FrameRecord record;
  record.frame = {0.0, 1e-6};
  for (int i = 0; i < 3; ++i) model.history.add(record);
  const std::set<std::string> texts = shown(model);
  EXPECT_TRUE(texts.contains("done"));
  EXPECT_EQ(logged(model).find("0.0 ms a frame"), std::string::npos);
}

TEST(Texts, TheWordsAreTheFields) {
  Model model = full_model();
  const std::regex ours("Why so|\\bslides\\b|\\bbeside\\b|\\bage\\b|waits for whom|who waits");
  for (const std::string& text : shown(model)) EXPECT_FALSE(std::regex_search(text, ours)) << text;
}

}  // namespace
}  // namespace pinocchio::app
