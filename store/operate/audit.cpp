// SPDX-License-Identifier: Apache-2.0
#include "store/operate/audit.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <cstdint>
#include <utility>

#include "core/base/line_journal.h"
#include "core/base/utf8.h"
#include "store/vars/retain.h"

namespace indurop::operate {
namespace {

constexpr std::uintmax_t kMaxAuditBytes = 8U << 20;

// Without a limit, a user who may write could push all other entries out of the log by a few long ones.
std::string shortened(std::string text) {
  if (text.size() <= kMaxAuditText) {
    return text;
  }
  std::size_t end = kMaxAuditText;
  while (end > 0 && base::continues_utf8(text[end])) {
    --end;
  }
  return fmt::format("{}... ({} bytes in all)", std::string_view(text).substr(0, end), text.size());
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

std::string append_audit(const std::filesystem::path& file, AuditEntry entry) {
  for (std::string* const text :
       {&entry.who, &entry.from, &entry.board, &entry.action, &entry.what, &entry.outcome, &entry.reason}) {
    *text = shortened(std::move(*text));
  }
  return base::append_line({file, kMaxAuditBytes, S_IRUSR | S_IWUSR, base::Durable::Yes}, json_of(entry).dump());
}

std::vector<AuditEntry> read_audit(const std::filesystem::path& file, std::size_t most) {
  std::vector<AuditEntry> all;
  base::each_line(file, [&all](std::string_view line) {
    if (auto entry = parse_audit_line(line)) {
      all.push_back(std::move(*entry));
    }
  });
  if (all.size() > most) {
    all.erase(all.begin(), all.end() - static_cast<std::ptrdiff_t>(most));
  }
  return all;
}

}  // namespace indurop::operate
