// SPDX-License-Identifier: Apache-2.0
// indurop new: a project that builds and runs.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <string_view>

#include "base/program_folder.h"
#include "base/replace_file.h"
#include "glb2idl/names.h"
#include "tools/command/package_folder.h"
#include "tools/verbs/new_templates.h"
#include "tools/verbs/verbs.h"

namespace indurop::tools {
namespace {

namespace fs = std::filesystem;

// A name that CMake, make and a shell take without quotes.
bool good_name(const std::string& name) {
  constexpr std::size_t kLongest = 60;
  return !name.empty() && name.size() <= kLongest && std::isalpha(static_cast<unsigned char>(name[0])) != 0 &&
         std::all_of(name.begin(), name.end(),
                     [](unsigned char c) { return c < 0x80 && (std::isalnum(c) != 0 || c == '_' || c == '-'); });
}

std::string filled_in(std::string text, const std::vector<std::pair<std::string, std::string>>& words) {
  for (const auto& [word, value] : words) {
    for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + value.size())) {
      text.replace(at, word.size(), value);
    }
  }
  return text;
}

// The project's name as that of a namespace, which none of its variables may have.
std::string namespace_of(const std::string& project) {
  constexpr std::array<std::string_view, 5> kVariables{"gain", "wave", "smoothed", "starts", "seen"};
  std::string name = project;
  std::replace(name.begin(), name.end(), '-', '_');
  const bool taken = std::find(kVariables.begin(), kVariables.end(), name) != kVariables.end();
  const bool refused = glb2idl::objection(name, glb2idl::NameRole::Namespace, true).has_value();
  return taken || refused ? name + "_project" : name;
}

// "0.1.0" -> "0.1": what find_package asks for.
std::string minor_version() {
  const std::string whole = INDUROP_VERSION;
  return whole.substr(0, whole.find('.', whole.find('.') + 1));
}

bool write_project(Context& context, const fs::path& folder, const std::string& name) {
  const fs::path programs = base::program_folder();
  const fs::path package = package_folder(programs);
  if (package.empty()) {
    context.out.note(
        "the CMake package of InduRoP was not found beside this program; if `make` does not find it either: "
        "make INDUROP_PACKAGE=<folder of InduRoPConfig.cmake>");
  }
  const std::string space = namespace_of(name);
  for (const ProjectFile& file : project_files()) {
    const fs::path path = folder / filled_in(file.path, {{"@NAMESPACE@", space}, {"@NAME@", name}});
    std::error_code error;
    fs::create_directories(path.parent_path(), error);
    std::string problem = error ? fmt::format("cannot make {}: {}", path.parent_path().string(), error.message()) : "";
    if (problem.empty()) {
      const std::string text = filled_in(file.text, {{"@NAME@", name},
                                                     {"@NAMESPACE@", space},
                                                     {"@GTEST@", "gtest/gtest.h"},
                                                     {"@PACKAGE@", package.string()},
                                                     {"@PROGRAMS@", programs.string()},
                                                     {"@VERSION@", minor_version()}});
      const auto saved = base::replace_file(path, text, base::Durable::No);
      problem = saved ? "" : base::cannot_write(path, saved.error());
    }
    if (!problem.empty()) {
      context.out.error(problem);
      return false;
    }
  }
  return true;
}

int make_project(Context& context, const std::string& where) {
  const fs::path folder(where);
  const std::string name = folder.filename().string();
  if (!good_name(name)) {
    context.out.error(fmt::format(
        "'{}' is not a project name: begin with a letter, then letters, digits, '_' or '-', at most 60", name));
    return kUsage;
  }
  std::error_code error;
  if (fs::exists(folder, error) && !(fs::is_directory(folder, error) && fs::is_empty(folder, error))) {
    context.out.error(fmt::format("there is already something called {}; nothing was written", where));
    return kFailed;
  }
  fs::create_directories(folder, error);
  if (error) {
    context.out.error(fmt::format("cannot make {}: {}", where, error.message()));
    return kFailed;
  }
  if (!write_project(context, folder, name)) {
    return kFailed;
  }
  context.out.line(fmt::format("made {}", where));
  context.out.note(fmt::format("next: cd {} && make && indurop run", where));
  return kOk;
}

Action declare(base::Options& app, Context& /*context*/) {
  auto name = std::make_shared<std::string>();
  app.add("name", "NAME", *name, "Name of the project, or the path of its folder").required();
  return [name](Context& c) { return make_project(c, *name); };
}

}  // namespace

const Verb kNewVerb{
    "new", "Before it runs", "Make a project that builds and runs",
    "A .glb file, two thread modules, a process module, a test, module.xml, CMakeLists.txt, Makefile, README.\n"
    "It never writes into a folder that is not empty.\n"
    "Examples:\n"
    "  indurop new demo\n",
    &declare};

}  // namespace indurop::tools
