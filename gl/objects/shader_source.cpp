#include "gl/objects/shader_source.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>

#include "gl/context/error.h"

namespace pinocchio::gl {
namespace {

constexpr std::size_t kDeepestInclude = 8;

class Assembler {
 public:
  Assembler(const ShaderSource& source, const std::vector<std::string>& definitions)
      : source_(source), definitions_(definitions) {}

  void add(const std::string& file, std::size_t depth) {
    const std::optional<std::string> text = source_.read(file);
    if (!text) throw Error(source_.path(file) + ": cannot be read");
    if (depth > kDeepestInclude) throw Error(source_.path(file) + ": includes itself");
    const std::size_t number = shader.files.size();
    shader.files.push_back(source_.path(file));
    if (number > 0) mark(1, number);

    std::istringstream in(*text);
    std::string line;
    for (int n = 1; std::getline(in, line); ++n) {
      constexpr std::string_view kInclude = "#include \"";
      if (line.rfind(kInclude, 0) == 0) {
        add(line.substr(kInclude.size(), line.rfind('"') - kInclude.size()), depth + 1);
        mark(n + 1, number);
      } else {
        shader.text += line + "\n";
        if (line.rfind("#version", 0) == 0) {
          for (const std::string& definition : definitions_) shader.text += "#define " + definition + "\n";
          mark(n + 1, number);
        }
      }
    }
  }

  AssembledShader shader;

 private:
  void mark(int line, std::size_t file) {
    shader.text += "#line " + std::to_string(line) + " " + std::to_string(file) + "\n";
  }

  const ShaderSource& source_;
  const std::vector<std::string>& definitions_;
};

}  // namespace

std::optional<std::string> ShaderSource::read(const std::string& name) const {
  if (folder_.empty()) {
    const auto found = std::ranges::find(built_in_, name, &BuiltInShader::name);
    return found != built_in_.end() ? std::optional<std::string>(found->text) : std::nullopt;
  }
  std::ifstream in(folder_ / name);
  if (!in) return std::nullopt;
  return std::string(std::istreambuf_iterator<char>(in), {});
}

std::string ShaderSource::path(const std::string& name) const {
  return ((folder_.empty() ? "shaders" : folder_) / name).string();
}

AssembledShader assemble_shader(const ShaderSource& source, const std::string& file,
                                const std::vector<std::string>& definitions) {
  Assembler assembler(source, definitions);
  assembler.add(file, 0);
  return std::move(assembler.shader);
}

std::string name_files(const std::string& log, const std::vector<std::string>& files) {
  static const std::regex kPlace(R"((\d+)[:(](\d+)\)?(\(\d+\))?)");
  std::string named;
  auto at = log.cbegin();
  for (std::smatch match; std::regex_search(at, log.cend(), match, kPlace); at = match.suffix().first) {
    const std::size_t number = std::stoul(match[1].str());
    named += match.prefix().str();
    named += number < files.size() ? files[number] + ":" + match[2].str() : match.str();
  }
  return named.append(at, log.cend());
}

}  // namespace pinocchio::gl
