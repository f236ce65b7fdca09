// SPDX-License-Identifier: Apache-2.0
#include "tools/values/forcing.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <span>

#include "base/user_name.h"
#include "explain/orders.h"
#include "rt/clock.h"
#include "tools/command/audit.h"
#include "tools/values/value_source.h"

namespace indurop::tools {
namespace {

std::string what_failed(const Error& error) {
  if (error.code == Errc::NoSpace) {
    return fmt::format(
        "a node holds at most {} numbers (a text counts as one for each 8 characters); let some go: "
        "indurop unforce",
        vars::kMostForces);
  }
  return error.code == Errc::Busy ? fmt::format("{}: somebody who has it is stopped; try again", error.where)
                                  : fmt::format("{} ({})", error.where, to_string(error.code));
}

bool lies_in(const vars::Force& force, const Item& item) {
  const std::uint64_t begin = item.place.offset;
  return force.variable == item.entry && force.offset >= begin && force.offset < begin + item.place.type.size();
}

void note_order(const Context& context, const vars::Store& store, const char* action, const std::string& name,
                const std::string& value, std::int64_t until_ns = 0) {
  if (!context.values->here()) {
    return;
  }
  explain::note_order(context.node, {rt::to_ns(store.now()), 0, context.who, context.from, action, name, value,
                                     until_ns, context.reason});
}

// What comes over HTTP is in the audit log already.
void note_for_audit(const Context& context, const char* action, const std::string& what) {
  if (context.who.empty() && context.values->here()) {
    (void)append_audit(usual_audit_file(),
                       {rt::wall_ns(), base::user_name(), "", context.node, action, what, "done", context.reason});
  }
}

std::string text_of(const std::vector<Assignment>& assignments) {
  std::string text;
  for (const Assignment& one : assignments) {
    text += fmt::format("{}{}={}", text.empty() ? "" : " ", one.item.name, one.text);
  }
  return text;
}

// What `indurop forces` tells about it. A node of an older version keeps no notes.
vars::ForceNote note_about(const Context& context, bool lease) {
  vars::ForceNote note;
  note.who = context.who.empty() ? base::user_name() : context.who;
  note.from = context.from;
  note.reason = context.reason;
  note.wall_ns = rt::wall_ns();
  note.lease = lease;
  return note;
}

template <class Wanted>
int let_go_if(Context& context, vars::Store& store, std::vector<std::string>& gone, Wanted wanted) {
  if (!may(context, context.node, vars::Act::Force)) {
    return kFailed;
  }
  for (const vars::Force& one : store.forces()) {
    if (!wanted(one)) {
      continue;
    }
    const std::string name = schema::part_at(store.schema().variables[one.variable->schema_index], one.offset).name;
    const Status status = store.let_go(*one.variable, one.offset);
    if (!status.ok() && status.error().code != Errc::NotFound) {
      context.out.error(what_failed(status.error()));
      return kUnreachable;
    }
    if (gone.empty() || gone.back() != name) {  // words of one text
      note_order(context, store, "unforce", name, {});
      gone.push_back(name);
    }
  }
  if (!gone.empty()) {
    note_for_audit(context, "unforce", fmt::format("{}", fmt::join(gone, " ")));
  }
  return kOk;
}

std::vector<vars::HeldValue> to_hold(const std::vector<Assignment>& assignments) {
  std::vector<vars::HeldValue> values;
  for (const Assignment& one : assignments) {
    const schema::Place& place = one.item.place;
    values.push_back(
        {one.item.entry, place.offset, place.type, one.bytes, vars::parts_to_hold(place.type, one.text, one.bytes)});
  }
  return values;
}

}  // namespace

bool may(Context& context, const std::string& node, vars::Act act) {
  if (context.values != nullptr && !context.values->here()) {
    return true;
  }
  const auto why = vars::refusal(vars::lock_of(node), act);
  if (why) {
    context.out.error(fmt::format("node '{}': {}", node, *why));
  }
  return !why;
}

bool may_set(Context& context, const std::vector<Assignment>& assignments) {
  const bool tuning = std::all_of(assignments.begin(), assignments.end(),
                                  [](const Assignment& one) { return one.item.place.variable->given; });
  return may(context, context.node, tuning ? vars::Act::SetParameter : vars::Act::Set);
}

int set_values(Context& context, vars::Store& store, const std::vector<Assignment>& assignments) {
  if (!may_set(context, assignments)) {
    return kFailed;
  }
  for (const Assignment& one : assignments) {
    const Item& item = one.item;
    if (const auto done = context.values->set(store, item.name, *item.entry, item.place, one.bytes); !done) {
      return report(context.out, done.error());
    }
    note_order(context, store, "set", one);
  }
  note_for_audit(context, "set", text_of(assignments));
  return kOk;
}

void note_order(const Context& context, const vars::Store& store, const char* action, const Assignment& one) {
  note_order(context, store, action, one.item.name, schema::format_value(one.item.place.type, one.bytes));
}

int hold_values(Context& context, vars::Store& store, const std::vector<Assignment>& assignments, std::int64_t for_ns,
                Lease* lease) {
  if (!may(context, context.node, vars::Act::Force)) {
    return kFailed;
  }
  std::vector<vars::HeldValue> values = to_hold(assignments);
  const rt::MonoTime until = for_ns > 0 ? store.now() + std::chrono::nanoseconds(for_ns) : vars::kForever;
  if (const Status forced = vars::hold(context.node, store, values, until, note_about(context, lease != nullptr));
      !forced.ok()) {
    context.out.error(fmt::format("{} not forced: {}",
                                  assignments.size() == 1 ? assignments[0].item.name + " is" : "these are",
                                  what_failed(forced.error())));
    return forced.error().code == Errc::Busy ? kUnreachable : kFailed;
  }
  const bool open_end = until == vars::kForever || lease != nullptr;
  for (const Assignment& one : assignments) {
    note_order(context, store, "force", one.item.name, schema::format_value(one.item.place.type, one.bytes),
               open_end ? INT64_MAX : rt::to_ns(until));
  }
  note_for_audit(context, "force", text_of(assignments));
  if (lease != nullptr) {
    *lease = {std::move(values), until};
  }
  return kOk;
}

bool renew(Lease& lease, vars::Store& store, std::int64_t for_ns) {
  const rt::MonoTime until = store.now() + std::chrono::nanoseconds(for_ns);
  const Status held = vars::prolong(store, lease.values, lease.until, until);
  lease.until = until;
  return held.ok();
}

void end(const Context& context, Lease& lease, vars::Store& store) {
  (void)vars::let_go(store, lease.values, lease.until);
  std::string names;
  for (const vars::HeldValue& value : lease.values) {
    const schema::Variable& variable = store.schema().variables[value.variable->schema_index];
    const std::string name = schema::part_at(variable, value.offset).name;
    note_order(context, store, "unforce", name, {});
    names += (names.empty() ? "" : " ") + name;
  }
  note_for_audit(context, "unforce", names);
  lease.values.clear();
}

int let_values_go(Context& context, vars::Store& store, const std::vector<Item>& items,
                  std::vector<std::string>& gone) {
  return let_go_if(context, store, gone, [&items](const vars::Force& one) {
    return std::any_of(items.begin(), items.end(), [&one](const Item& item) { return lies_in(one, item); });
  });
}

int let_all_go(Context& context, vars::Store& store, std::vector<std::string>& gone) {
  return let_go_if(context, store, gone, [](const vars::Force& /*one*/) { return true; });
}

// Writing to a forced value would be for nothing.
bool any_forced(Context& context, const vars::Store& store, const std::vector<Assignment>& assignments) {
  bool any = false;
  for (const vars::Force& force : store.forces()) {
    for (const Assignment& one : assignments) {
      const Item& item = one.item;
      const std::uint64_t begin = item.place.offset;
      if (force.variable == item.entry && force.offset < begin + one.bytes.size() &&
          begin < force.offset + force.size) {
        context.out.error(fmt::format("{} is forced; release it first: indurop unforce '{}'", item.name, item.name));
        any = true;
      }
    }
  }
  return any;
}

}  // namespace indurop::tools
