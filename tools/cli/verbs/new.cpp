// SPDX-License-Identifier: Apache-2.0
// indurop new: creates a project that builds and runs.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <string_view>

#include "core/base/program_folder.h"
#include "core/base/replace_file.h"
#include "glb2idl/names.h"
#include "tools/cli/command/package_folder.h"
#include "tools/cli/verbs/new_templates.h"
#include "tools/cli/verbs/verbs.h"

namespace indurop::tools {
namespace {

namespace fs = std::filesystem;

// Returns true for a name that CMake, make and a shell accept without quotes.
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

// The project's name as a namespace, which none of its variables may have.
std::string namespace_of(const std::string& project) {
  constexpr std::array<std::string_view, 5> kVariables{"gain", "wave", "smoothed", "starts", "seen"};
  std::string name = project;
  std::replace(name.begin(), name.end(), '-', '_');
  const bool taken = std::find(kVariables.begin(), kVariables.end(), name) != kVariables.end();
  const bool refused = glb2idl::objection(name, glb2idl::NameRole::Namespace, true).has_value();
  return taken || refused ? name + "_project" : name;
}

// Returns "0.1" for "0.1.0", as find_package requires.
std::string minor_version() {
  const std::string whole = INDUROP_VERSION;
  return whole.substr(0, whole.find('.', whole.find('.') + 1));
}

struct NewOptions {
  std::string where;
  std::vector<std::string> with;
  std::uint64_t boards = 1;

  [[nodiscard]] bool plc() const { return std::find(with.begin(), with.end(), "plc") != with.end(); }
};

using Words = std::vector<std::pair<std::string, std::string>>;

Words words_of(const NewOptions& options, const std::string& name, const fs::path& programs, const fs::path& package) {
  // Texts that contain placeholders themselves come first.
  return {{"@PLC@", options.plc() ? plc_build() : ""},
          {"@PLC_ROW@",
           options.plc() ? "| `src/logic.st` | PLC program, a thread module; its `lamp` is `@NAMESPACE@_plc::lamp` |\n"
                         : ""},
          {"@PLANT_ROW@", options.boards > 1 ? "| `plant.xml` | the same modules on several boards |\n" : ""},
          {"@NAMESPACE@", namespace_of(name)},
          {"@NAME@", name},
          {"@GTEST@", "gtest/gtest.h"},
          {"@PACKAGE@", package.string()},
          {"@PROGRAMS@", programs.string()},
          {"@VERSION@", minor_version()}};
}

bool write_file(Context& context, const fs::path& path, const std::string& text) {
  std::error_code error;
  fs::create_directories(path.parent_path(), error);
  std::string problem = error ? fmt::format("cannot make {}: {}", path.parent_path().string(), error.message()) : "";
  if (problem.empty()) {
    const auto saved = base::replace_file(path, text, base::Durable::No);
    problem = saved ? "" : base::cannot_write(path, saved.error());
  }
  if (!problem.empty()) {
    context.out.error(problem);
  }
  return problem.empty();
}

bool write_project(Context& context, const fs::path& folder, const std::string& name, const NewOptions& options) {
  const fs::path programs = base::program_folder();
  const fs::path package = package_folder(programs);
  if (package.empty()) {
    context.out.note(
        "the CMake package of InduRoP was not found next to this program; if `make` does not find it either: "
        "make INDUROP_PACKAGE=<folder of InduRoPConfig.cmake>");
  }
  const auto modules = project_modules(options.plc());
  std::vector<std::pair<std::string, std::string>> files{{"module.xml", module_xml(modules)}};
  for (const ProjectFile& file : project_files()) {
    files.emplace_back(file.path, file.text);
  }
  if (options.plc()) {
    files.emplace_back(plc_file().path, plc_file().text);
  }
  if (options.boards > 1) {
    files.emplace_back("plant.xml", plant_xml(modules, options.boards));
  }
  const Words words = words_of(options, name, programs, package);
  return std::all_of(files.begin(), files.end(), [&](const auto& file) {
    return write_file(context, folder / filled_in(file.first, words), filled_in(file.second, words));
  });
}

int make_project(Context& context, const NewOptions& options) {
  const std::string& where = options.where;
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
  if (!write_project(context, folder, name, options)) {
    return kFailed;
  }
  context.out.line(fmt::format("made {}", where));
  context.out.note(
      fmt::format("next: cd {} && make && indurop run{}", where, options.boards > 1 ? " plant.xml --local" : ""));
  return kOk;
}

Action declare_new(base::Options& app, Context& /*context*/) {
  constexpr std::uint64_t kMaxBoards = 64;
  auto options = std::make_shared<NewOptions>();
  app.add("name", "NAME", options->where, "Name of the project, or the path of its folder").required();
  app.add("--with", "WHAT", options->with, "plc: a program in Structured Text, too").choices({"plc"});
  app.add("--boards", "N", options->boards, "Also a plant.xml that distributes the modules to N boards")
      .range(1, kMaxBoards);
  return [options](Context& c) { return make_project(c, *options); };
}

}  // namespace

const Verb kNewVerb{
    "new", "Before it runs", "Make a project that builds and runs",
    "The project has a .glb file, two thread modules, a process module, a test, module.xml, CMakeLists.txt, a\n"
    "Makefile and a README. The verb never writes to a folder that is not empty.\n"
    "Examples:\n"
    "  indurop new demo\n"
    "  indurop new line --with plc --boards 3\n",
    &declare_new};

}  // namespace indurop::tools
