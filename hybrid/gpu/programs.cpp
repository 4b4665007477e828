#include "hybrid/gpu/programs.h"

#include "gl/context/error.h"

namespace pinocchio {

const gl::Program& Programs::get(const std::string& vertex_file, const std::string& fragment_file,
                                 const Definitions& definitions) {
  Key key{vertex_file, fragment_file, definitions};
  const auto found = programs_.find(key);
  if (found != programs_.end()) return found->second;
  gl::Program program = compile(key);  // before emplace, as it may throw
  return programs_.emplace(std::move(key), std::move(program)).first->second;
}

Expected<void> Programs::reload() {
  std::map<Key, gl::Program> fresh;
  try {
    for (const auto& [key, old] : programs_) fresh.emplace(key, compile(key));
  } catch (const gl::Error& error) {
    return Unexpected(InputError{{}, 0, error.what(), "the last good shaders stay in use"});
  }
  for (auto& [key, program] : programs_) program = std::move(fresh.at(key));
  ++generation_;
  return {};
}

gl::Program Programs::compile(const Key& key) const {
  const auto& [vertex_file, fragment_file, definitions] = key;
  return {shaders_, vertex_file, fragment_file, definitions};
}

}  // namespace pinocchio
