// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/audit.h"

#include "core/rt/clock.h"

namespace indurop::serve {

std::string Audit::note(AuditEntry entry) const {
  entry.wall_ns = rt::wall_ns();
  return operate::append_audit(file_, entry);
}

}  // namespace indurop::serve
