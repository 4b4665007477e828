#include "app/window/model/preferences.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/files/atomic_file.h"
#include "pinocchio/error.h"

namespace pinocchio::app {
namespace {

constexpr std::size_t kMostRecent = 12;
constexpr std::size_t kFirstRemembered = 1;  // all panels but Help

std::string text_of(const nlohmann::json& json, const char* name) {
  const auto found = json.find(name);
  return found != json.end() && found->is_string() ? found->get<std::string>() : std::string();
}

std::vector<std::string> texts_of(const nlohmann::json& json, const char* name) {
  std::vector<std::string> texts;
  const auto found = json.find(name);
  if (found == json.end() || !found->is_array()) return texts;
  for (const nlohmann::json& text : *found)
    if (text.is_string()) texts.push_back(text.get<std::string>());
  return texts;
}

}  // namespace

void Preferences::add_recent(const std::string& file) {
  std::error_code unknown;
  const std::string full = std::filesystem::absolute(file, unknown).string();
  std::erase(recent, full);
  recent.insert(recent.begin(), full);
  if (recent.size() > kMostRecent) recent.resize(kMostRecent);
}

std::filesystem::path preferences_file() {
  const char* const config = std::getenv("XDG_CONFIG_HOME");
  const char* const home = std::getenv("HOME");
  if (config && config[0] == '/') return std::filesystem::path(config) / "pinocchio/window.json";
  if (home && home[0] == '/') return std::filesystem::path(home) / ".config/pinocchio/window.json";
  return {};
}

Preferences load_preferences(const std::filesystem::path& file) {
  Preferences preferences;
  std::ifstream in(file);
  const nlohmann::json json = nlohmann::json::parse(in, nullptr, false);
  if (!json.is_object()) return preferences;
  const std::vector<std::string> open = texts_of(json, "open");
  for (std::size_t i = kFirstRemembered; i < kPanels.size(); ++i)
    preferences.panels[static_cast<Panel>(i)] = std::ranges::find(open, kPanels[i].title) != open.end();
  preferences.layout = text_of(json, "layout");
  preferences.recent = texts_of(json, "recent");
  return preferences;
}

void save_preferences(const Preferences& preferences, const std::filesystem::path& file) {
  if (file.empty()) return;
  nlohmann::json json{{"layout", preferences.layout}, {"recent", preferences.recent}};
  json["open"] = nlohmann::json::array();
  for (std::size_t i = kFirstRemembered; i < kPanels.size(); ++i)
    if (preferences.panels[static_cast<Panel>(i)]) json["open"].push_back(kPanels[i].title);
  std::error_code failed;
  std::filesystem::create_directories(file.parent_path(), failed);
  if (failed) return;
  try {
    write_text(file, json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
  } catch (const EnvironmentError&) {
    // An error at the end of every run would help nobody whose home is read-only.
  }
}

}  // namespace pinocchio::app
