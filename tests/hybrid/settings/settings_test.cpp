// The one table of settings: text, JSON, presets, rules.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "hybrid/settings/json.h"
#include "hybrid/settings/resolve.h"
#include "pinocchio/frame.h"
#include "tests/support/own_file.h"

namespace pinocchio {
namespace {

// Values that the field may have.
std::vector<std::string> values_of(const Field& field) {
  if (!field.choices.empty()) return {field.choices.begin(), field.choices.end()};
  if (field.kind == Field::Kind::text) return {field.examples.begin(), field.examples.end()};
  const auto text = [&](double value) {
    return field.kind == Field::Kind::whole ? std::to_string(static_cast<long>(value))
                                            : nlohmann::json(static_cast<float>(value)).dump();
  };
  return {text(field.lo), text(field.hi), text(field.lo + 0.3 * (field.hi - field.lo))};
}

Expected<Settings> load(const std::string& text) {
  const std::filesystem::path file = own_file("plan.json");
  std::ofstream(file) << text;
  return load_settings(file);
}

std::string error_of(const std::string& text) {
  const Expected<Settings> settings = load(text);
  EXPECT_FALSE(settings) << text;
  return settings ? "" : settings.error().message();
}

void expect_error(const std::string& text, const std::string& words) {
  const std::string message = error_of(text);
  EXPECT_NE(message.find(words), std::string::npos) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

std::vector<std::string_view> given_in(const Settings& settings) {
  std::vector<std::string_view> names;
  for (const Field& field : settings_table())
    if (field.given(settings)) names.push_back(field.name);
  return names;
}

Settings with(std::initializer_list<std::pair<std::string_view, std::string_view>> fields) {
  Settings settings;
  for (const auto& [name, value] : fields) EXPECT_TRUE(set(settings, name, value)) << name << " " << value;
  return settings;
}

TEST(SettingsTable, EveryFieldIsNamedOnceAndSaysWhatItIs) {
  for (const Field& field : settings_table()) {
    EXPECT_EQ(find_field(field.name), &field);
    EXPECT_FALSE(field.help.empty()) << field.name;
    EXPECT_FALSE(field.unset.empty()) << field.name;
    EXPECT_FALSE(field.domain().empty()) << field.name;
    EXPECT_EQ(field.option().substr(0, 2), "--");
    EXPECT_EQ(field.option().find('_'), std::string::npos);
    EXPECT_FALSE(field.given(Settings())) << field.name;
    if (!field.formerly.empty()) {
      EXPECT_EQ(find_field(field.formerly), &field);
    }
  }
  EXPECT_EQ(find_field("mask_bit"), nullptr);
  EXPECT_EQ(find_field(""), nullptr);
}

TEST(SettingsTable, EveryValueGoesThereAndBackAsTextAndJson) {
  for (const Field& field : settings_table())
    for (const std::string& value : values_of(field)) {
      SCOPED_TRACE(std::string(field.name) + " " + value);
      Settings settings;
      ASSERT_TRUE(field.take(value, settings));
      EXPECT_EQ(given_in(settings), std::vector<std::string_view>{field.name});
      Settings again;
      ASSERT_TRUE(set(again, field.name, field.text(settings)));
      EXPECT_TRUE(field.same(settings, again));
      EXPECT_EQ(settings, again);
      const Expected<Settings> loaded = load(to_json(settings).dump(2));
      ASSERT_TRUE(loaded) << loaded.error().message();
      EXPECT_EQ(*loaded, settings);
      EXPECT_EQ(given_in(*loaded).size(), settings_table().size());
      Settings copied;
      field.copy(settings, copied);
      EXPECT_EQ(copied, settings);
      EXPECT_TRUE(field.given(copied));
    }
}

TEST(SettingsTable, WhatIsNoValueIsRefusedAndChangesNothing) {
  for (const Field& field : settings_table()) {
    std::vector<std::string> wrong{"",    "none of them", "1x",    " 1",
                                   "nan", "inf",          "1e999", "99999999999999999999"};
    if (field.kind == Field::Kind::whole) wrong.insert(wrong.end(), {"1.5", "3000000", "-1"});
    if (field.kind == Field::Kind::number)
      wrong.insert(wrong.end(), {std::to_string(field.lo - 0.001), std::to_string(1.001 * field.hi), "-inf"});
    if (field.kind == Field::Kind::flag) wrong.insert(wrong.end(), {"1", "yes", "True"});
    for (const std::string& value : wrong) {
      Settings settings;
      const Expected<void> done = set(settings, field.name, value);
      ASSERT_FALSE(done) << field.name << " '" << value << "'";
      EXPECT_NE(done.error().message().find(field.domain()), std::string::npos) << done.error().message();
      EXPECT_EQ(settings, Settings());
      EXPECT_TRUE(given_in(settings).empty());
    }
  }
  Settings settings;
  const Expected<void> unknown = set(settings, "mask_bit", "2");
  ASSERT_FALSE(unknown);
  EXPECT_NE(unknown.error().message().find("no setting 'mask_bit'"), std::string::npos);
}

TEST(SettingsTable, WhatIsGivenReplacesAndNothingElse) {
  Settings settings = with({{"depth", "3"}, {"mask_bits", "2"}});
  override_with(with({{"depth", "5"}, {"isa", "scalar"}}), settings);
  EXPECT_EQ(settings, with({{"depth", "5"}, {"mask_bits", "2"}, {"isa", "scalar"}}));
  EXPECT_EQ(given_in(settings).size(), 3u);
}

TEST(SettingsFile, MayBePartialAndLieUnderPlan) {
  EXPECT_EQ(*load("{}"), Settings());
  EXPECT_TRUE(given_in(*load("{}")).empty());
  const Settings some = with({{"reflection", "rgb9e5"}, {"mask_scale", "2"}, {"light_cutoff", "0.001"}});
  EXPECT_EQ(*load(R"({"reflection": "rgb9e5", "mask_scale": 2, "light_cutoff": 1e-3})"), some);
  EXPECT_EQ(given_in(*load(R"({"reflection": "rgb9e5", "mask_scale": 2, "light_cutoff": 1e-3})")),
            given_in(some));
  EXPECT_EQ(*load(nlohmann::json{{"plan", to_json(some)}, {"more", 1}}.dump()), some);
}

TEST(SettingsFile, WithoutTheMachineIsWhatAPictureDependsOn) {
  const nlohmann::json of_picture = to_json({}, false), whole = to_json({});
  for (const Field& field : settings_table()) {
    EXPECT_TRUE(whole.contains(field.name));
    EXPECT_EQ(of_picture.contains(field.name), !field.of_machine) << field.name;
  }
  EXPECT_FALSE(of_picture.contains("threads"));
}

TEST(SettingsFile, MistakesAreNamedWithTheirLine) {
  expect_error("{\n\"mask_bits\": 2,\n\"mask_bit\": 2}", "plan.json:3: there is no setting 'mask_bit'");
  expect_error("{\n\"mask_bits\": \"two\"}", "plan.json:2: mask_bits is \"two\"");
  expect_error("{\"mask_bits\": \"2\"}", "mask_bits is \"2\"");
  expect_error("{\"reflection\": \"rgb5\"}", "rgb9e5");
  expect_error("{\"tiles\": 1}", "it is false or true");
  expect_error("{\n\n,}", "plan.json:3: is no JSON");
  expect_error("", "is no JSON");
  expect_error("[1, 2]", "is no plan");
  expect_error("{\"plan\": 3}", "is no plan");
  expect_error("{\"mask_bits\": 3}", "it is 0, 1, 2, 4, 8, 16, 32 or 64");
  expect_error("{\"id_bits\": 8}", "it is 16, 24 or 32");
  expect_error("{\"mask_scale\": 3}", "it is 1, 2 or 4");
  expect_error("{\"depth\": 1e9}", "depth is");
  expect_error("{\"depth\": 1e999}", "too large");
  expect_error("{\"depth\": null}", "depth is null");
  expect_error("{\"depth\": 65}", "a whole number from 0 to 64");
  expect_error("{\"light_cutoff\": -1}", "a number from 0 to 1");
  EXPECT_FALSE(load_settings("no-such-plan.json"));
  EXPECT_FALSE(load_settings(own_folder()));  // a folder
}

// As the program before this table wrote them.
TEST(SettingsFile, FormerFilesStillRead) {
  const auto former = [](const std::string& mode, int design, const std::string& primary) {
    return *load(R"({"mode": ")" + mode + R"(", "design": )" + std::to_string(design) + R"(, "primary": ")" +
                 primary +
                 R"(", "id_bits": 16, "normals": false, "wide": false, "mask_bits": 2, "mask_scale": 1,
      "reflection": "half", "reflection_scale": 1, "tiles": false, "depth": 4, "least_contribution": 0.25,
      "least_light": 0.125, "reuse": true, "precise": false, "threads": 3})");
  };
  using enum Processor;
  const auto expect = [](const Settings& s, Processor visibility, Processor composite) {
    EXPECT_EQ(s.visibility, visibility);
    EXPECT_EQ(s.composite, composite);
    EXPECT_EQ(s.throughput_cutoff, 0.25f);
    EXPECT_EQ(s.light_cutoff, 0.125f);
    EXPECT_EQ(s.threads, 3);
  };
  expect(former("hybrid", 1, "raster"), gpu, gpu);
  expect(former("hybrid", 1, "rays"), cpu, gpu);
  expect(former("hybrid", 2, "raster"), gpu, cpu);
  expect(former("raytrace", 1, "raster"), cpu, cpu);
  expect(former("raytrace", 2, "raster"), cpu, cpu);
  expect(former("raster", 1, "raster"), gpu, gpu);
  EXPECT_FALSE(former("raster", 1, "raster").traces());
  EXPECT_EQ(former("hybrid", 1, "raster").depth, 4);
  expect_error("{\n\"mode\": \"magic\"}", "plan.json:2: mode is \"magic\"; write visibility and composite");
  expect_error("{\n\n\"design\": 3}", "plan.json:3: design is 3");
  expect_error("{\"primary\": []}", "primary is []");
  expect_error("{\"precise\": true}", "--precise is said on the command line");
}

TEST(Presets, AreWhatTheirNamesSay) {
  Settings none;
  EXPECT_FALSE(apply_preset("mode", "magic", none));
  EXPECT_FALSE(apply_preset("magic", "1", none));
  EXPECT_EQ(none, Settings());
  for (const Preset& preset : presets()) {
    EXPECT_FALSE(preset.help.empty());
    Settings settings;
    ASSERT_TRUE(apply_preset(preset.option, preset.value, settings));
    EXPECT_EQ(broken_rule(settings), nullptr) << preset.option << " " << preset.value;
    EXPECT_TRUE(resolve(settings, {})) << preset.option << " " << preset.value;
  }
  const auto applied = [](std::initializer_list<std::pair<std::string_view, std::string_view>> rows) {
    Settings settings;
    for (const auto& [option, value] : rows) EXPECT_TRUE(apply_preset(option, value, settings));
    return settings;
  };
  EXPECT_EQ(applied({{"mode", "hybrid"}, {"design", "1"}, {"plan", "auto"}}), Settings());
  EXPECT_EQ(applied({{"mode", "raytrace"}}), with({{"visibility", "cpu"}, {"composite", "cpu"}}));
  EXPECT_EQ(applied({{"design", "2"}}), with({{"visibility", "gpu"}, {"composite", "cpu"}}));
  EXPECT_FALSE(applied({{"mode", "raster"}}).traces());
  EXPECT_EQ(applied({{"mode", "raytrace"}, {"plan", "slides"}}), applied({{"mode", "raytrace"}}));
  EXPECT_EQ(applied({{"mode", "raster"}, {"plan", "slides"}}), applied({{"mode", "raster"}}));
  EXPECT_TRUE(applied({{"plan", "slides"}}).normals);
  EXPECT_TRUE(applied({{"design", "2"}, {"plan", "slides"}}).wide);
}

TEST(Rules, SayWhatCannotBeAndWhatToDo) {
  EXPECT_EQ(broken_rule({}), nullptr);
  struct Case {
    Settings settings;
    const char* words;
  };
  for (const Case& one : {Case{with({{"exchange", "reproject"}, {"composite", "cpu"}}), "reproject"},
                          Case{with({{"composite", "cpu"}, {"mask_scale", "2"}}), "mask_scale"},
                          Case{with({{"composite", "cpu"}, {"reflection_scale", "4"}}), "reflection_scale"},
                          Case{with({{"composite", "cpu"}, {"tiles", "true"}}), "tiles"},
                          Case{with({{"visibility", "cpu"}, {"normals", "true"}}), "normals"},
                          Case{with({{"wide", "true"}}), "wide"}}) {
    const Rule* const broken = broken_rule(one.settings);
    ASSERT_NE(broken, nullptr) << one.words;
    EXPECT_NE(broken->what.find(one.words), std::string::npos) << broken->what;
    const Expected<Settings> resolved = resolve(one.settings, {});
    ASSERT_FALSE(resolved);
    EXPECT_EQ(resolved.error().message(), std::string(broken->what) + "; " + std::string(broken->remedy));
  }
  for (const Rule& rule : settings_rules()) {
    EXPECT_FALSE(rule.what.empty());
    EXPECT_FALSE(rule.remedy.empty());
  }
}

// What greys a widget.
TEST(Rules, TellBeforehandWhatAValueWouldBreak) {
  const Settings design2 = with({{"composite", "cpu"}});
  const Rule* const tiles = broken_by(design2, "tiles", "true");
  ASSERT_NE(tiles, nullptr);
  EXPECT_NE(tiles->what.find("tiles"), std::string::npos);
  EXPECT_NE(broken_by(design2, "exchange", "reproject"), nullptr);
  EXPECT_EQ(broken_by(design2, "exchange", "pipelined"), nullptr);
  EXPECT_EQ(broken_by(design2, "tiles", "false"), nullptr);
  EXPECT_EQ(broken_by(design2, "wide", "true"), nullptr);
  EXPECT_NE(broken_by({}, "wide", "true"), nullptr);
  EXPECT_EQ(design2, with({{"composite", "cpu"}}));  // asked only
  for (const std::string_view isa : kIsaNames)
    EXPECT_EQ(broken_by({}, "isa", isa) == nullptr, isa_supported(*parse_name<Isa>(kIsaNames, isa))) << isa;
}

// What figures, the trace export and the window's timeline say of each mode.
TEST(Processors, OfEachStageInEachMode) {
  const auto name_of = [](Stage stage, const Settings& settings) {
    const std::optional<Processor> processor = processor_of(stage, settings);
    return processor ? std::string(kProcessorNames[static_cast<std::size_t>(*processor)]) : "none";
  };
  const struct {
    const char *visibility, *composite, *raster, *picture;
  } kModes[] = {{"gpu", "gpu", "gpu", "gpu"},  // hybrid of design 1, and raster
                {"gpu", "cpu", "gpu", "gpu"},  // design 2: the GPU copies the CPU's picture
                {"cpu", "gpu", "cpu", "gpu"},
                {"cpu", "cpu", "cpu", "cpu"}};  // raytrace
  for (const auto& mode : kModes) {
    const Settings s = with({{"visibility", mode.visibility}, {"composite", mode.composite}});
    EXPECT_EQ(name_of(Stage::raster, s), mode.raster);
    EXPECT_EQ(name_of(Stage::composite, s), mode.picture);
    for (const Stage stage : {Stage::pose, Stage::trees, Stage::trace_shadow, Stage::trace_reflection})
      EXPECT_EQ(name_of(stage, s), "cpu");
    for (const Stage stage : {Stage::readback, Stage::upload, Stage::present})
      EXPECT_EQ(name_of(stage, s), "none");
  }
}

// Every combination of who finds and who composites can be had.
TEST(Rules, AllowAllFourSchedules) {
  for (const char* visibility : {"cpu", "gpu"})
    for (const char* composite : {"cpu", "gpu"})
      for (const char* exchange : {"sync", "pipelined"})
        EXPECT_TRUE(resolve(
            with({{"visibility", visibility}, {"composite", composite}, {"exchange", exchange}}), {}));
}

}  // namespace
}  // namespace pinocchio
