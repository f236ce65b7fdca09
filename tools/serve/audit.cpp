// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/audit.h"

#include "core/rt/clock.h"

namespace indurop::serve {

std::string Audit::note(AuditEntry entry) const {
  entry.wall_ns = rt::wall_ns();
  return operate::append_audit(file_, std::move(entry));
}

void Audit::note_soon(AuditEntry entry) {
  entry.wall_ns = rt::wall_ns();
  {
    const std::lock_guard guard(lock_);
    waiting_.push_back(std::move(entry));
  }
  (void)worker_.add([this] { note_waiting(); });  // if too many jobs wait, one of them notes this entry, too
}

void Audit::note_waiting() {
  std::vector<AuditEntry> entries;
  {
    const std::lock_guard guard(lock_);
    entries.swap(waiting_);
  }
  for (AuditEntry& entry : entries) {
    (void)operate::append_audit(file_, std::move(entry));  // nothing was written, so a missing entry hides nothing
  }
}

}  // namespace indurop::serve
