// SPDX-License-Identifier: Apache-2.0
#include "deploy/check.h"

#include <algorithm>

#include "deploy/check_parts.h"

namespace indurop::deploy {

bool CheckResult::ok() const noexcept {
  return !has_error(diagnostics);
}

CheckResult check_config(Config& config, const CheckOptions& options) {
  CheckResult result;
  CheckContext context{config, options, result, Report(config.file.string(), result.diagnostics)};
  check_schedule(context);
  if (options.files) {
    check_machine(context);
    check_files(context);
    check_access(context);
  }
  const auto rank = [](const Diagnostic& d) { return static_cast<int>(d.severity); };
  std::stable_sort(result.diagnostics.begin(), result.diagnostics.end(),
                   [rank](const Diagnostic& a, const Diagnostic& b) { return rank(a) < rank(b); });
  return result;
}

}  // namespace indurop::deploy
