// SPDX-License-Identifier: Apache-2.0
#include "serve/api/audit.h"

#include <chrono>

namespace indurop::serve {

std::string Audit::note(AuditEntry entry) const {
  using std::chrono::system_clock;
  const auto now = system_clock::now().time_since_epoch();
  entry.wall_ns = std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
  return tools::append_audit(file_, entry);
}

}  // namespace indurop::serve
