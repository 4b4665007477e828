# cmake -D FOLDER=... -D "NAMES=a.frag;..." -D OUTPUT=... -P embed_shaders.cmake: writes the definition of
# built_in_shaders() (hybrid/gpu/shaders.h) with the texts of the files NAMES of FOLDER.
set(table "")
foreach(name IN LISTS NAMES)
  file(READ "${FOLDER}/${name}" text)
  string(APPEND table "    {\"${name}\", R\"glsl(${text})glsl\"},\n")
endforeach()
file(WRITE "${OUTPUT}" "#include \"hybrid/gpu/shaders.h\"

namespace pinocchio {

std::span<const gl::BuiltInShader> built_in_shaders() {
  static constexpr gl::BuiltInShader kShaders[] = {
${table}  };
  return kShaders;
}

}  // namespace pinocchio
")
