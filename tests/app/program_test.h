// The program, run in a folder of its own; what OpenGL drivers complain about is an error.
#pragma once

#include <gtest/gtest.h>

#include "pinocchio/tracer.h"
#include "tests/support/command.h"
#include "tests/support/own_file.h"

namespace pinocchio {

class ProgramTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = own_folder() / "run";
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_ / "scratch");
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] CommandResult run(const std::string& arguments, const std::string& environment = "") const {
    return run_command("cd '" + folder_.string() + "' && PINOCCHIO_GL_DEBUG=1 " + environment +
                           " '" PINOCCHIO_PROGRAM "' " + arguments,
                       folder_ / "scratch");
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  [[nodiscard]] bool exists(const std::string& name) const { return std::filesystem::exists(folder_ / name); }
  // Files made, the scratch folder aside.
  [[nodiscard]] std::size_t files() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder_), {})) - 1;
  }
  [[nodiscard]] static std::string scene(const std::string& name) {
    return " '" PINOCCHIO_SOURCE_DIR "/scenes/" + name + "' ";
  }

  // The option for the narrowest lanes that every processor of this architecture has.
  [[nodiscard]] static std::string four_lanes() {
    return "--isa " + std::string(isa_name(supported_isas().at(1)));
  }

  std::filesystem::path folder_;
};

}  // namespace pinocchio
