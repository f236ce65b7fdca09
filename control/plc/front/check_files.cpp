// SPDX-License-Identifier: Apache-2.0
#include "control/plc/front/check_files.h"

#include <indurop/detail/abi.h>

#include <algorithm>
#include <filesystem>

#include "control/plc/check/checker.h"
#include "control/plc/check/shared_names.h"
#include "control/plc/front/reader.h"
#include "glb2idl/compiler.h"

namespace indurop::plc {
namespace {

bool is_name(std::string_view name) noexcept {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  return !name.empty() && is_letter(name[0]) &&
         std::all_of(name.begin(), name.end(), [&](char c) { return is_letter(c) || (c >= '0' && c <= '9'); });
}

// Returns "prog" for ".../prog.st"; characters that C++ does not allow in a name become '_'.
std::string name_from(const std::string& file) {
  std::string name = std::filesystem::path(file).stem().string();
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !is_name(std::string("a") + c); }, '_');
  for (std::size_t at = name.find("__"); at != std::string::npos; at = name.find("__")) {
    name.erase(at, 1);  // reserved in C++
  }
  return is_name(name) ? name : "plc_" + name;
}

std::vector<schema::Variable> variables_of(const glb2idl::Program& program) {
  std::vector<schema::Variable> out;
  for (const glb2idl::GlbFile& unit : program.units) {
    for (const glb2idl::Item& item : unit.items) {
      if (const auto* variable = std::get_if<schema::Variable>(&item)) {
        out.push_back(*variable);
      }
    }
  }
  return out;
}

}  // namespace

bool is_module_name(std::string_view name) noexcept {
  return is_name(name);
}

std::string module_name(const CompileOptions& options) {
  return options.name.empty() && !options.files.empty() ? name_from(options.files[0]) : options.name;
}

std::string module_of(const Program& program, const TaskPlan& task, const std::string& name) {
  const bool only = program.tasks.size() == 1;
  return only ? name : name + "_" + (task.name.empty() ? "default" : task.name);
}

std::unique_ptr<Program> check_files(const CompileOptions& options, const std::string& name,
                                     const glb2idl::FileReader& read, Diagnostics& diagnostics,
                                     std::vector<base::Diagnostic>& of_glb) {
  CheckOptions check_options;
  check_options.library = options.library;
  check_options.infinite_division = options.infinite_division;
  check_options.space = !options.space.empty() ? options.space : name_of_space(name);
  if (!options.glb_files.empty()) {
    auto foreign = glb2idl::compile(options.glb_files, read);
    if (!foreign.ok) {
      of_glb = std::move(foreign.diagnostics);
      diagnostics.error({}, "the .glb files above have errors, correct them first");
      return nullptr;
    }
    check_options.foreign = variables_of(foreign.program);
  }
  std::uint64_t text = 0;
  const auto reading = [&](const std::string& path) {
    glb2idl::ReadResult out = read(path);
    const std::string all = std::to_string(text) + out.text.value_or("");
    text = abi::fnv1a64(all.data(), all.size());
    return out;
  };
  Project project = read_project(options.files, options.libraries, {options.watch, options.dialect == Dialect::Codesys},
                                 reading, diagnostics);
  project.dialect = options.dialect.value_or(project.dialect);
  if (project.incomplete) {
    return nullptr;  // omitted items would cause errors at all their uses
  }
  auto program = check(std::move(project), std::move(check_options), diagnostics);
  if (program != nullptr) {
    for (TaskPlan& task : program->tasks) {
      for (TaskProgram& one : task.programs) {
        one.text = text;
      }
    }
  }
  return program;
}

}  // namespace indurop::plc
