// generate: writes a procedural scene to glTF or OBJ.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "app/cli/console.h"
#include "app/cli/errors.h"
#include "app/cli/parse.h"
#include "app/verbs/verbs.h"
#include "core/scene/formats.h"
#include "pinocchio/save.h"
#include "scenes/generator/scenes.h"

namespace pinocchio::app {
namespace {

struct GenerateOptions {
  std::string name;
  std::string file;
  ProceduralOptions procedural;
};

int generate(const GenerateOptions& options) {
  const std::string file = options.file.empty() ? options.name + ".gltf" : options.file;
  if (const auto error = save_error(file)) throw Exit(kUsage, error->message());
  ProceduralOptions procedural = options.procedural;
  procedural.progress = &run_progress();
  const Scene scene = value_or_exit(make_procedural(options.name, procedural), kUsage);
  Warnings warnings;
  save_scene(scene, file, &run_progress(), &warnings);
  print_warnings(warnings);
  std::printf("%s: %zu triangles\n", file.c_str(), scene.mesh->triangles.size());
  return kDone;
}

}  // namespace

Run add_generate(CLI::App& program) {
  auto options = std::make_shared<GenerateOptions>();
  CLI::App& verb = *program.add_subcommand("generate", "write a procedural scene to a glTF or OBJ file");
  verb.add_option("NAME", options->name, listed(procedural_names(), ", ", ", "))->required();
  verb.add_option("--triangles", options->procedural.triangles,
                  "number of triangles, about (the scene's own number)")
      ->check(CLI::Range(100, 100'000'000));
  verb.add_option("-o", options->file,
                  "file to write: " + scene_extensions(FormatUse::written) + " (NAME.gltf)");
  return [options] { return generate(*options); };
}

}  // namespace pinocchio::app
