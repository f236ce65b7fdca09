// SPDX-License-Identifier: Apache-2.0
// The audit log, who wrote what and from where: a file of JSON lines that `indurop serve` and verbs append to and
// `indurop audit` shows.

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/json.h"

namespace indurop::operate {

struct AuditEntry {
  std::int64_t wall_ns = 0;  // CLOCK_REALTIME
  std::string who;
  std::string from;
  std::string board;
  std::string action;   // "set", "force", "release", "stop"
  std::string what;     // "gain=2.5 mode=AUTO"
  std::string outcome;  // "done", else why not
  std::string reason;
};

base::Json json_of(const AuditEntry& entry);
// Returns nothing if the line is not an entry of the audit log.
std::optional<AuditEntry> parse_audit_line(std::string_view line);

// The default file, in the state folder: all servers of this user write to the same one.
std::filesystem::path usual_audit_file();
inline constexpr std::size_t kMaxAuditText = 4096;  // bytes of each text of an entry that are kept
// Appends one whole line and syncs it to the disk. A file larger than 8 MiB is first renamed to FILE.1. Texts that are
// too long are cut, with their length. Returns why that failed, else an empty text.
std::string append_audit(const std::filesystem::path& file, AuditEntry entry);
// Returns the newest `most` entries, oldest first, including those of FILE.1. Empty if there is no such file.
std::vector<AuditEntry> read_audit(const std::filesystem::path& file, std::size_t most);

}  // namespace indurop::operate
