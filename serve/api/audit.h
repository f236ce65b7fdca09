// SPDX-License-Identifier: Apache-2.0
// Writes are done only if they can be noted down: the audit log of this server.

#pragma once

#include <filesystem>
#include <string>
#include <utility>

#include "tools/command/audit.h"

namespace indurop::serve {

using tools::AuditEntry;
using tools::json_of;
using tools::read_audit;

class Audit {
 public:
  explicit Audit(std::filesystem::path file) : file_(std::move(file)) {}
  [[nodiscard]] const std::filesystem::path& file() const noexcept { return file_; }
  // Any thread. Why it could not be noted down, else nothing.
  std::string note(AuditEntry entry) const;

 private:
  std::filesystem::path file_;
};

}  // namespace indurop::serve
