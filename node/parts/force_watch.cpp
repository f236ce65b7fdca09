// SPDX-License-Identifier: Apache-2.0
#include "node/parts/force_watch.h"

#include <algorithm>

#include "core/rt/clock.h"
#include "store/vars/custody.h"

namespace indurop::node {
namespace {

schema::Part part_of(const vars::Store& store, const vars::Force& force) {
  return schema::part_at(store.schema().variables[force.variable->schema_index], force.offset);
}

}  // namespace

std::string ForceWatch::time_of(const Known& known, rt::MonoTime now) {
  const vars::Force& force = known.force;
  if (known.lease) {
    return "as long as its client renews that";
  }
  const std::chrono::duration<double> left = force.until - now;
  return force.until == vars::kForever ? "until it is released (indurop unforce)"
                                       : fmt::format("for {:.1f} s", left.count());
}

bool ForceWatch::is_lease(const vars::Force& force) const {
  const auto custody = vars::Custody::open(node_, vars::Mode::ReadOnly);
  const auto note = custody ? custody->note_of(*force.variable, force.offset) : std::nullopt;
  return note && note->lease;
}

void ForceWatch::report_changes(vars::Store& store, Console& console) {
  std::vector<Known> now;
  for (const vars::Force& one : store.forces()) {
    const auto before = std::find_if(known_.begin(), known_.end(), [&](const Known& k) { return k.is_of(one); });
    const bool held = before != known_.end() && before->force.value == one.value;
    const bool unchanged = held && before->force.until == one.until;
    const schema::Part part = part_of(store, one);
    now.push_back({one, one.variable->offset, part.name, unchanged ? before->lease : is_lease(one)});
    const bool renewed = held && before->lease && now.back().lease;
    if (!unchanged && !renewed) {
      console.warning("{} is forced to {} {}", part.name, schema::format_value(part.type, one.bytes()),
                      time_of(now.back(), store.now()));
    }
  }
  for (const Known& one : known_) {
    if (std::none_of(now.begin(), now.end(), [&](const Known& k) { return one.is_of(k.force); })) {
      console.info("{} is no longer forced", one.name);
      store.release_overdue();
    }
  }
  known_ = std::move(now);
}

}  // namespace indurop::node
