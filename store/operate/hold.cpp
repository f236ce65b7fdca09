// SPDX-License-Identifier: Apache-2.0
#include "store/operate/hold.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "core/base/user_name.h"
#include "store/operate/journal.h"
#include "store/operate/set.h"
#include "store/vars/custody.h"

namespace indurop::operate {
namespace {

Refusal failure(const std::string& what, const Error& error) {
  switch (error.code) {
    case Errc::NoSpace:
      return {Why::Wrong,
              {fmt::format("{}: a node holds at most {} numbers (a text counts as one for each 8 characters); release "
                           "some: indurop unforce",
                           what, vars::kMaxForces)}};
    case Errc::Busy:
      return {Why::Busy, {fmt::format("{}: a process that holds its lock was stopped; try again", what)}};
    default:
      return {Why::Wrong, {fmt::format("{}: {} ({})", what, error.where, to_string(error.code))}};
  }
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

// The note that `indurop forces` shows. A node of an older version keeps no notes.
vars::ForceNote note_about(const Who& who, Ends ends) {
  vars::ForceNote about;
  about.who = who.name.empty() ? base::user_name() : who.name;
  about.from = who.from;
  about.reason = who.reason;
  about.wall_ns = rt::wall_ns();
  about.lease = ends == Ends::UnlessRenewed;
  return about;
}

void note_release(const std::string& node, const vars::Store& store, const std::string& name, const Who& who) {
  note(node, {rt::to_ns(store.now()), 0, who.name, who.from, "unforce", name, {}, 0, who.reason});
}

template <class Wanted>
Result<std::vector<std::string>, Refusal> release_if(const std::string& node, vars::Store& store, const Who& who,
                                                     Wanted wanted) {
  if (auto locked = refusal(node, vars::Act::Force)) {
    return std::move(*locked);
  }
  std::vector<std::string> released;
  for (const vars::Force& one : store.forces()) {
    if (!wanted(one)) {
      continue;
    }
    const std::string name = schema::part_at(store.schema().variables[one.variable->schema_index], one.offset).name;
    const Status status = store.release(*one.variable, one.offset);
    if (!status && status.error().code != Errc::NotFound) {
      return failure(name + " is still forced", status.error());
    }
    if (released.empty() || released.back() != name) {  // words of one text
      note_release(node, store, name, who);
      released.push_back(name);
    }
  }
  return released;
}

}  // namespace

Result<Lease, Refusal> hold(const std::string& node, vars::Store& store, const std::vector<Assignment>& assignments,
                            std::int64_t for_ns, Ends ends, const Who& who) {
  if (auto locked = refusal(node, vars::Act::Force)) {
    return std::move(*locked);
  }
  Lease lease{to_hold(assignments),
              {},
              for_ns > 0 ? store.now() + std::chrono::nanoseconds(for_ns) : rt::MonoTime(vars::kForever)};
  if (const Status held = vars::hold(node, store, lease.values, lease.until, note_about(who, ends)); !held) {
    return failure(
        assignments.size() == 1 ? assignments[0].item.name + " is not forced" : "these values are not forced",
        held.error());
  }
  const bool open_end = lease.until == vars::kForever || ends == Ends::UnlessRenewed;
  for (const Assignment& one : assignments) {
    lease.names.push_back(one.item.name);
    note(node, {rt::to_ns(store.now()), 0, who.name, who.from, "force", one.item.name,
                schema::format_value(one.item.place.type, one.bytes), open_end ? INT64_MAX : rt::to_ns(lease.until),
                who.reason});
  }
  return lease;
}

Result<void, Refusal> renew(Lease& lease, vars::Store& store, std::int64_t for_ns) {
  const rt::MonoTime until = store.now() + std::chrono::nanoseconds(for_ns);
  const Status held = vars::prolong(store, lease.values, lease.until, until);
  lease.until = until;
  return held ? Result<void, Refusal>()
              : Refusal{Why::Forced, {"another user released or re-forced one of the values"}};
}

void end(const std::string& node, vars::Store& store, Lease& lease, const Who& who) {
  (void)vars::release(store, lease.values, lease.until);  // NotFound: another user has released one of them
  for (const std::string& name : lease.names) {
    note_release(node, store, name, who);
  }
  lease = {};
}

Result<std::vector<std::string>, Refusal> release(const std::string& node, vars::Store& store,
                                                  const std::vector<Item>& items, const Who& who) {
  return release_if(node, store, who, [&items](const vars::Force& one) {
    return std::any_of(items.begin(), items.end(), [&one](const Item& item) { return lies_in(one, item); });
  });
}

Result<std::vector<std::string>, Refusal> release_all(const std::string& node, vars::Store& store, const Who& who) {
  return release_if(node, store, who, [](const vars::Force& /*one*/) { return true; });
}

}  // namespace indurop::operate
