// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/command/config_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "config/xml/plant_reader.h"
#include "config/xml/reader.h"
#include "tools/client/robot/robot_files.h"

namespace indurop::tools {
namespace {

using Severity = base::Diagnostic::Severity;

const char* to_text(Severity severity) {
  switch (severity) {
    case Severity::Error:
      return "error";
    case Severity::Warning:
      return "warning";
    case Severity::Note:
      return "note";
  }
  return "error";
}

void append(const std::vector<base::Diagnostic>& from, std::vector<base::Diagnostic>& to) {
  to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

bool CheckedConfig::ok() const {
  return !base::has_error(diagnostics);
}

bool CheckedPlant::ok() const {
  return !base::has_error(diagnostics);
}

Result<std::string, Failure> find_config(const std::string& file) {
  std::error_code ignored;
  const auto exists = [&ignored](const std::string& name) { return std::filesystem::exists(name, ignored); };
  if (!file.empty() && !exists(file)) {
    return Failure{kFailed, fmt::format("there is no file '{}'", file)};
  }
  if (!file.empty()) {
    return file;
  }
  for (const char* name : {"module.xml", "plant.xml"}) {
    if (exists(name)) {
      return std::string(name);
    }
  }
  return Failure{kUsage, "there is no module.xml or plant.xml here; say which file to read"};
}

CheckedConfig load_config(const std::string& file, const config::CheckOptions& options) {
  auto read = config::read_config(file);
  CheckedConfig out{std::move(read.config), {}, std::move(read.diagnostics)};
  if (out.ok()) {
    out.check = config::check_config(out.config, options);
    append(out.check.diagnostics, out.diagnostics);
    if (options.files) {
      append(check_robot_files(out.config, out.check), out.diagnostics);
    }
  }
  return out;
}

CheckedPlant load_plant(const std::string& file, config::CheckOptions options) {
  options.machine = false;
  auto read = config::read_plant(file);
  CheckedPlant out{std::move(read.plant), {}, std::move(read.diagnostics)};
  if (out.ok()) {
    out.check = config::check_plant(out.plant, options);
    append(out.check.diagnostics, out.diagnostics);
    for (std::size_t i = 0; options.files && i < out.check.boards.size(); ++i) {
      append(check_robot_files(out.plant.boards[i].config, out.check.boards[i]), out.diagnostics);
    }
  }
  return out;
}

void print_diagnostics(Context& context, const std::vector<base::Diagnostic>& diagnostics, bool as_data) {
  for (const auto& diagnostic : diagnostics) {
    if (!as_data) {
      context.out.message_line(base::to_string(diagnostic));
      continue;
    }
    const Style style = diagnostic.severity == Severity::Error     ? Style::Bad
                        : diagnostic.severity == Severity::Warning ? Style::Warn
                                                                   : Style::Dim;
    const base::DiagnosticLine line = base::line_of(diagnostic);
    context.out.line(line.place + context.out.paint(style, line.word) + line.text);
  }
}

std::string counted(std::size_t n, const char* noun) {
  return fmt::format("{} {}{}", n, noun, n == 1 ? "" : "s");
}

void print_verdict(Context& context, const std::vector<base::Diagnostic>& diagnostics, const std::string& content) {
  const auto count = [&diagnostics](Severity severity) {
    return static_cast<std::size_t>(std::count_if(diagnostics.begin(), diagnostics.end(),
                                                  [severity](const auto& d) { return d.severity == severity; }));
  };
  const std::size_t errors = count(Severity::Error);
  const std::size_t warnings = count(Severity::Warning);
  const std::string warned = warnings > 0 ? ", " + counted(warnings, "warning") : "";
  context.out.line(errors == 0 ? context.out.paint(Style::Good, "OK") + "  " + content + warned
                               : context.out.paint(Style::Bad, "FAILED") + "  " + counted(errors, "error") + warned);
}

JsonValue diagnostics_json(const std::vector<base::Diagnostic>& diagnostics) {
  JsonValue out = JsonValue::array();
  for (const auto& d : diagnostics) {
    out.push_back({{"severity", to_text(d.severity)},
                   {"file", d.file},
                   {"line", d.place.line},
                   {"column", d.place.column},
                   {"text", d.text}});
  }
  return out;
}

}  // namespace indurop::tools
