// SPDX-License-Identifier: Apache-2.0
#include "config/check/check.h"

#include <algorithm>
#include <array>

#include "config/check/check_parts.h"

namespace indurop::config {

bool CheckResult::ok() const noexcept {
  return !base::has_error(diagnostics);
}

CheckResult check_config(Config& config, const CheckOptions& options) {
  CheckResult result;
  SchemaTexts texts;
  CheckContext context{config, options, result, base::Diagnostics(config.file.string(), result.diagnostics), texts};
  check_schedule(context);
  if (options.files) {
    check_machine(context);
    check_files(context);
    check_data_flow(context);
    check_load(context);
    if (options.simulation) {
      check_determinism(context);
    }
    if (options.kept) {
      check_kept(context);
    }
    const std::array<BoardView, 1> alone{BoardView{"", config, result}};
    check_agreement(alone, context.report);
    const Uses uses(alone);
    check_writers(uses, check_external(context, uses), context.report);
  }
  if (!options.files) {
    check_load(context);
  }
  context.report.add_summary(result.diagnostics);
  sort_by_severity(result.diagnostics);
  return result;
}

void sort_by_severity(std::vector<base::Diagnostic>& diagnostics) {
  const auto rank = [](const base::Diagnostic& d) { return static_cast<int>(d.severity); };
  std::stable_sort(diagnostics.begin(), diagnostics.end(),
                   [rank](const base::Diagnostic& a, const base::Diagnostic& b) { return rank(a) < rank(b); });
}

}  // namespace indurop::config
