// SPDX-License-Identifier: Apache-2.0
#include "tools/client/board/board_run.h"

#include <fmt/format.h>

#include <utility>

namespace indurop::tools {
namespace {

std::vector<ForceView> forces_in(const JsonValue& head) {
  std::vector<ForceView> forces;
  const JsonValue* list = head.find("forces");
  for (const JsonValue& one : list == nullptr ? std::vector<JsonValue>() : list->values()) {
    ForceView force;
    std::int64_t left_ns = 0;
    if (read(one, "name", force.name) && read(one, "value", force.value)) {
      force.raw = one["raw"];
      force.left_ns = read(one, "left_ns", left_ns) ? std::optional(left_ns) : std::nullopt;
      read(one, "who", force.note.who);
      read(one, "from", force.note.from);
      read(one, "reason", force.note.reason);
      read(one, "lease", force.note.lease);
      forces.push_back(std::move(force));
    }
  }
  return forces;
}

vars::LockNote lock_in(const JsonValue& head) {
  vars::LockNote note;
  std::string word;
  const JsonValue& lock = head["lock"];
  if (read(lock, "lock", word)) {
    note.lock = vars::write_lock_of(word).value_or(vars::WriteLock::None);
  }
  read(lock, "who", note.who);
  read(lock, "from", note.from);
  read(lock, "reason", note.reason);
  read(lock, "wall_ns", note.wall_ns);
  return note;
}

}  // namespace

Result<BoardRun, Failure> read_run(const std::string& who, const std::string& text) {
  const auto line = text.find('\n');
  const JsonValue head = JsonValue::parse(text.substr(0, line)).value_or(JsonValue());
  bool running = false;
  std::int64_t now_ns = 0;
  if (line == std::string::npos || !read(head, "running", running) || !read(head, "now_ns", now_ns)) {
    return Failure{kFailed, fmt::format("{} does not report the state of a node", who)};
  }
  if (line + 1 == text.size()) {
    return Failure{kUnreachable, fmt::format("{} has no node that runs or ran", who)};
  }
  auto run = RunView::from_image(std::string_view(text).substr(line + 1), running, now_ns);
  if (!run) {
    return run.error().code == Errc::VersionMismatch
               ? Failure{kSchemaMismatch, fmt::format("{} is of another release of InduRoP", who)}
               : Failure{kFailed, fmt::format("the data of {} is damaged ({})", who, run.error().where)};
  }
  const std::string node = fixed_text(run->block().node_name);
  return BoardRun{{node, std::move(run).value()}, forces_in(head), lock_in(head)};
}

}  // namespace indurop::tools
