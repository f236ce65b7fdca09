// SPDX-License-Identifier: Apache-2.0
#include "store/operate/set.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <utility>

#include "core/base/user_name.h"
#include "core/rt/clock.h"
#include "store/operate/journal.h"

namespace indurop::operate {
namespace {

std::optional<Refusal> not_written(const std::string& name, const Error& error) {
  if (error.code == Errc::Busy) {
    return Refusal{Why::Busy, {fmt::format("{}: a process that writes it was stopped; try again", name)}};
  }
  return Refusal{Why::Wrong, {fmt::format("{} cannot be written: {} ({})", name, error.where, to_string(error.code))}};
}

// Parts of a struct that the text leaves out are not written: a module may be writing them.
std::optional<Refusal> write(vars::Store& store, const Assignment& one) {
  const Status written = store.write(*one.item.entry, one.item.place.offset, one.bytes, given_bytes(one));
  return written ? std::nullopt : not_written(one.item.name, written.error());
}

}  // namespace

std::string Refusal::text() const {
  return fmt::format("{}", fmt::join(reasons, "; "));
}

std::optional<Refusal> refusal(const std::string& node, vars::Act act) {
  auto why = vars::refusal(vars::lock_of(node), act);
  return why ? std::optional(Refusal{Why::Locked, {std::move(*why)}}) : std::nullopt;
}

std::optional<Refusal> refusal_to_set(const std::string& node, const std::vector<Assignment>& assignments) {
  const bool tuning = std::all_of(assignments.begin(), assignments.end(),
                                  [](const Assignment& one) { return one.item.place.variable->is_parameter(); });
  return refusal(node, tuning ? vars::Act::SetParameter : vars::Act::Set);
}

std::string is_forced(std::string_view name) {
  return fmt::format("{} is forced; release it first: indurop unforce '{}'", name, name);
}

std::optional<Refusal> forced(const vars::Store& store, const std::vector<Assignment>& assignments) {
  Refusal refusal{Why::Forced, {}};
  const std::vector<vars::Force> forces = store.forces();
  for (const Assignment& one : assignments) {
    if (std::any_of(forces.begin(), forces.end(), [&](const vars::Force& force) { return touches(force, one.item); })) {
      refusal.reasons.push_back(is_forced(one.item.name));
    }
  }
  return refusal.reasons.empty() ? std::nullopt : std::optional(std::move(refusal));
}

Result<void, Refusal> set(const std::string& node, vars::Store& store, const std::vector<Assignment>& assignments,
                          const Who& who) {
  if (auto locked = refusal_to_set(node, assignments)) {
    return std::move(*locked);
  }
  if (auto held = forced(store, assignments)) {
    return std::move(*held);
  }
  for (const Assignment& one : assignments) {
    if (auto wrong = write(store, one)) {
      return std::move(*wrong);
    }
    note_set(node, store, one, who);
  }
  return {};
}

void note_set(const std::string& node, const vars::Store& store, const Assignment& one, const Who& who) {
  note(node, {rt::to_ns(store.now()), 0, who.name, who.from, "set", one.item.name,
              schema::format_value(one.item.place.type, one.bytes), 0, who.reason});
}

Result<void, Refusal> set_lock(const std::string& node, vars::WriteLock lock, const Who& who) {
  auto custody = vars::Custody::open(node, vars::Mode::ReadWrite);
  if (!custody) {
    return Refusal{Why::Absent,
                   {custody.error().code == Errc::NotFound
                        ? fmt::format("node '{}' has not run yet, or was started by an older version", node)
                        : fmt::format("the write lock of node '{}' cannot be opened: {} ({})", node,
                                      custody.error().where, to_string(custody.error().code))}};
  }
  vars::LockNote about;
  about.who = who.name.empty() ? base::user_name() : who.name;
  about.from = who.from;
  about.reason = who.reason;
  about.wall_ns = rt::wall_ns();
  about.lock = lock;
  if (const Status locked = custody->set_lock(about); !locked) {
    return Refusal{
        Why::Busy,
        {fmt::format("node '{}' is not locked: a process that changes its lock was stopped; try again", node)}};
  }
  note(node, {rt::now_ns(), 0, who.name, who.from, "lock", vars::word_of(lock), {}, 0, who.reason});
  return {};
}

}  // namespace indurop::operate
