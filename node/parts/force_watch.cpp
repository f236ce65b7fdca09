// SPDX-License-Identifier: Apache-2.0
#include "node/parts/force_watch.h"

#include <algorithm>

#include "core/rt/clock.h"

namespace indurop::node {
namespace {

bool is_same(const vars::Force& a, const vars::Force& b) noexcept {
  return a.variable == b.variable && a.offset == b.offset;
}

const vars::Force* find(const std::vector<vars::Force>& in, const vars::Force& what) noexcept {
  const auto found = std::find_if(in.begin(), in.end(), [&](const vars::Force& one) { return is_same(one, what); });
  return found == in.end() ? nullptr : &*found;
}

schema::Part part_of(const vars::Store& store, const vars::Force& force) {
  return schema::part_at(store.schema().variables[force.variable->schema_index], force.offset);
}

std::string time_of(const vars::Force& force, rt::MonoTime now) {
  const std::chrono::duration<double> left = force.until - now;
  return force.until == vars::kForever ? "until it is released (indurop unforce)"
                                       : fmt::format("for {:.1f} s", left.count());
}

}  // namespace

void ForceWatch::report_changes(vars::Store& store, Console& console) {
  std::vector<vars::Force> now = store.forces();
  for (const vars::Force& one : now) {
    const vars::Force* before = find(known_, one);
    if (before == nullptr || before->value != one.value || before->until != one.until) {
      const schema::Part part = part_of(store, one);
      console.warning("{} is forced to {} {}", part.name, schema::format_value(part.type, one.bytes()),
                      time_of(one, store.now()));
    }
  }
  for (const vars::Force& one : known_) {
    if (find(now, one) == nullptr) {
      console.info("{} is no longer forced", part_of(store, one).name);
      store.release_overdue();
    }
  }
  known_ = std::move(now);
}

}  // namespace indurop::node
