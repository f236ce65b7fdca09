// SPDX-License-Identifier: Apache-2.0
// The audit log of this server. A write is done only if it can be logged.

#pragma once

#include <filesystem>
#include <string>
#include <utility>

#include "store/operate/audit.h"

namespace indurop::serve {

using operate::AuditEntry;
using operate::json_of;
using operate::read_audit;

class Audit {
 public:
  explicit Audit(std::filesystem::path file) : file_(std::move(file)) {}
  [[nodiscard]] const std::filesystem::path& file() const noexcept { return file_; }
  // May be called by any thread. Returns why the entry could not be logged, else an empty text.
  std::string note(AuditEntry entry) const;

 private:
  std::filesystem::path file_;
};

}  // namespace indurop::serve
