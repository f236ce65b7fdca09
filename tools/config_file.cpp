// SPDX-License-Identifier: Apache-2.0
#include "tools/config_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "deploy/reader.h"

namespace indurop::tools {
namespace {

using Severity = deploy::Diagnostic::Severity;

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

}  // namespace

bool CheckedConfig::ok() const {
  return std::none_of(diagnostics.begin(), diagnostics.end(),
                      [](const auto& d) { return d.severity == Severity::Error; });
}

std::optional<CheckedConfig> load_config(Context& context, const std::string& file, const deploy::CheckOptions& options,
                                         int& code) {
  const std::string name = file.empty() ? "module.xml" : file;
  std::error_code ignored;
  if (!std::filesystem::exists(name, ignored)) {
    context.out.error(file.empty() ? std::string("there is no module.xml here; say which file to read")
                                   : fmt::format("there is no file '{}'", name));
    code = file.empty() ? kUsage : kFailed;
    return {};
  }
  auto read = deploy::read_config(name);
  CheckedConfig out;
  out.config = std::move(read.config);
  out.diagnostics = std::move(read.diagnostics);
  if (out.ok()) {
    out.check = deploy::check_config(out.config, options);
    out.diagnostics.insert(out.diagnostics.end(), out.check.diagnostics.begin(), out.check.diagnostics.end());
  }
  return out;
}

void print_diagnostics(Context& context, const std::vector<deploy::Diagnostic>& diagnostics, bool as_data) {
  for (const auto& diagnostic : diagnostics) {
    if (!as_data) {
      context.out.message_line(deploy::to_string(diagnostic));
      continue;
    }
    const Style style = diagnostic.severity == Severity::Error     ? Style::Bad
                        : diagnostic.severity == Severity::Warning ? Style::Warn
                                                                   : Style::Dim;
    std::string line = deploy::to_string(diagnostic);
    const std::string word = std::string(to_text(diagnostic.severity)) + ":";
    const auto at = line.find(": " + word);
    if (at != std::string::npos) {
      line = line.substr(0, at + 2) + context.out.paint(style, word) + line.substr(at + 2 + word.size());
    }
    context.out.line(line);
  }
}

JsonValue diagnostics_json(const std::vector<deploy::Diagnostic>& diagnostics) {
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
