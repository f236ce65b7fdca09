// SPDX-License-Identifier: Apache-2.0
#include "deploy/check.h"

#include <algorithm>
#include <array>

#include "deploy/check_parts.h"

namespace indurop::deploy {

bool CheckResult::ok() const noexcept {
  return !has_error(diagnostics);
}

CheckResult check_config(Config& config, const CheckOptions& options) {
  CheckResult result;
  SchemaTexts texts;
  CheckContext context{config, options, result, Report(config.file.string(), result.diagnostics), texts};
  check_schedule(context);
  if (options.files) {
    check_machine(context);
    check_files(context);
    check_access(context);
    const std::array<BoardView, 1> alone{BoardView{"", config, result}};
    check_agreement(alone, context.report);
    const Uses uses(alone);
    check_use(uses, check_external(context, uses), context.report);
  }
  sort_by_severity(result.diagnostics);
  return result;
}

void sort_by_severity(std::vector<Diagnostic>& diagnostics) {
  const auto rank = [](const Diagnostic& d) { return static_cast<int>(d.severity); };
  std::stable_sort(diagnostics.begin(), diagnostics.end(),
                   [rank](const Diagnostic& a, const Diagnostic& b) { return rank(a) < rank(b); });
}

}  // namespace indurop::deploy
