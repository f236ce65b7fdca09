// SPDX-License-Identifier: Apache-2.0
// The audit log of this server. A write is done only if it can be logged.

#pragma once

#include <filesystem>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "store/operate/audit.h"
#include "tools/serve/worker.h"

namespace indurop::serve {

using operate::AuditEntry;
using operate::json_of;
using operate::read_audit;

class Audit {
 public:
  explicit Audit(std::filesystem::path file) : file_(std::move(file)) {}
  Audit(const Audit&) = delete;
  Audit& operator=(const Audit&) = delete;
  ~Audit() { note_waiting(); }
  [[nodiscard]] const std::filesystem::path& file() const noexcept { return file_; }
  // May be called by any thread. Returns why the entry could not be logged, else an empty text.
  std::string note(AuditEntry entry) const;
  // Logs what was refused, of which the door limits the number, on a thread of its own: the door's must not wait for a
  // disk, and behind the requests of clients, who can send many, an entry could be lost.
  void note_soon(AuditEntry entry);

 private:
  void note_waiting();

  std::filesystem::path file_;
  std::mutex lock_;
  std::vector<AuditEntry> waiting_;
  Worker worker_;
};

}  // namespace indurop::serve
