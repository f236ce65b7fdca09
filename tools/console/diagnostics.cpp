// SPDX-License-Identifier: Apache-2.0
#include "tools/console/diagnostics.h"

#include <fmt/format.h>

#include <algorithm>

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

}  // namespace

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
