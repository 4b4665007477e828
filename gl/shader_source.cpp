#include "gl/shader_source.h"

#include <fstream>
#include <regex>

#include "gl/error.h"

namespace pinocchio::gl {
namespace {

constexpr std::size_t kDeepestInclude = 8;

class Assembler {
 public:
  Assembler(const std::filesystem::path& folder, const std::vector<std::string>& definitions)
      : folder_(folder), definitions_(definitions) {}

  void add(const std::string& file, std::size_t depth) {
    std::ifstream in(folder_ / file);
    if (!in) throw Error((folder_ / file).string() + ": cannot be read; is the installation complete?");
    if (depth > kDeepestInclude) throw Error((folder_ / file).string() + ": includes itself");
    const std::size_t number = source.files.size();
    source.files.push_back((folder_ / file).string());
    if (number > 0) mark(1, number);

    std::string line;
    for (int n = 1; std::getline(in, line); ++n) {
      constexpr std::string_view kInclude = "#include \"";
      if (line.rfind(kInclude, 0) == 0) {
        add(line.substr(kInclude.size(), line.rfind('"') - kInclude.size()), depth + 1);
        mark(n + 1, number);
      } else {
        source.text += line + "\n";
        if (line.rfind("#version", 0) == 0) {
          for (const std::string& definition : definitions_) source.text += "#define " + definition + "\n";
          mark(n + 1, number);
        }
      }
    }
  }

  ShaderSource source;

 private:
  void mark(int line, std::size_t file) {
    source.text += "#line " + std::to_string(line) + " " + std::to_string(file) + "\n";
  }

  const std::filesystem::path& folder_;
  const std::vector<std::string>& definitions_;
};

}  // namespace

ShaderSource load_shader_source(const std::filesystem::path& folder, const std::string& file,
                                const std::vector<std::string>& definitions) {
  Assembler assembler(folder, definitions);
  assembler.add(file, 0);
  return std::move(assembler.source);
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
