// SPDX-License-Identifier: Apache-2.0
#include "tools/command/audit.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "base/descriptor.h"
#include "base/read_file.h"
#include "vars/retain.h"

namespace indurop::tools {
namespace {

constexpr std::uintmax_t kMostBytes = 8U << 20;

std::filesystem::path before(const std::filesystem::path& file) {
  return file.string() + ".1";
}

void read_lines(const std::filesystem::path& file, std::vector<AuditEntry>& to) {
  const auto text = base::read_file(file);
  std::string_view rest = text ? std::string_view(*text) : std::string_view();
  while (!rest.empty()) {
    const auto end = std::min(rest.find('\n'), rest.size());
    if (auto entry = parse_audit_line(rest.substr(0, end))) {
      to.push_back(std::move(*entry));
    }
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
}

}  // namespace

base::Json json_of(const AuditEntry& entry) {
  return {{"wall_ns", entry.wall_ns}, {"who", entry.who},   {"from", entry.from},       {"board", entry.board},
          {"action", entry.action},   {"what", entry.what}, {"outcome", entry.outcome}, {"reason", entry.reason}};
}

std::optional<AuditEntry> parse_audit_line(std::string_view line) {
  const auto json = base::Json::parse(line);
  AuditEntry entry;
  if (!json || !base::read(*json, "wall_ns", entry.wall_ns) || !base::read(*json, "action", entry.action)) {
    return std::nullopt;
  }
  base::read(*json, "who", entry.who);
  base::read(*json, "from", entry.from);
  base::read(*json, "board", entry.board);
  base::read(*json, "what", entry.what);
  base::read(*json, "outcome", entry.outcome);
  base::read(*json, "reason", entry.reason);
  return entry;
}

std::filesystem::path usual_audit_file() {
  return vars::state_directory("serve") / "audit.jsonl";
}

std::string append_audit(const std::filesystem::path& file, const AuditEntry& entry) {
  std::error_code error;
  std::filesystem::create_directories(file.parent_path(), error);
  if (const auto size = std::filesystem::file_size(file, error); !error && size > kMostBytes) {
    std::filesystem::rename(file, before(file), error);
  }
  const base::Descriptor fd(open(file.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, S_IRUSR | S_IWUSR));
  const std::string line = json_of(entry).dump() + "\n";
  if (fd.get() < 0 || write(fd.get(), line.data(), line.size()) != static_cast<ssize_t>(line.size()) ||
      fdatasync(fd.get()) != 0) {
    return std::strerror(errno);
  }
  return {};
}

std::vector<AuditEntry> read_audit(const std::filesystem::path& file, std::size_t most) {
  std::vector<AuditEntry> all;
  read_lines(before(file), all);
  read_lines(file, all);
  if (all.size() > most) {
    all.erase(all.begin(), all.end() - static_cast<std::ptrdiff_t>(most));
  }
  return all;
}

}  // namespace indurop::tools
