// SPDX-License-Identifier: Apache-2.0
#include "node/force_watch.h"

#include <algorithm>
#include <cstring>

#include "rt/clock.h"

namespace indurop::node {
namespace {

bool is_same(const vars::Force& a, const vars::Force& b) noexcept {
  return a.variable == b.variable && a.offset == b.offset;
}

const vars::Force* find(const std::vector<vars::Force>& in, const vars::Force& what) noexcept {
  const auto found = std::find_if(in.begin(), in.end(), [&](const vars::Force& one) { return is_same(one, what); });
  return found == in.end() ? nullptr : &*found;
}

std::string name_of(const vars::Store& store, const vars::Force& force) {
  return schema::name_at(store.schema().variables[force.variable->schema_index], force.offset);
}

std::string value_of(const vars::Store& store, const vars::Force& force, const std::string& name) {
  std::vector<std::uint8_t> bytes(force.size);
  std::memcpy(bytes.data(), &force.value, force.size);
  std::string message;
  const auto place = schema::find_place(store.schema(), "::" + name, message);
  return place ? schema::format_value(place->type, bytes) : "?";
}

std::string time_of(const vars::Force& force) {
  const std::int64_t left = force.until_ns - rt::now_ns();
  return force.until_ns == vars::kForever
             ? "until it is let go (indurop unforce)"
             : fmt::format("for {:.1f} s", static_cast<double>(left) / static_cast<double>(rt::kNanosPerSecond));
}

}  // namespace

void ForceWatch::look(vars::Store& store, Console& console) {
  std::vector<vars::Force> now = store.forces();
  for (const vars::Force& one : now) {
    const vars::Force* before = find(known_, one);
    if (before == nullptr || before->value != one.value || before->until_ns != one.until_ns) {
      const std::string name = name_of(store, one);
      console.warning("{} is forced to {} {}", name, value_of(store, one, name), time_of(one));
    }
  }
  for (const vars::Force& one : known_) {
    if (find(now, one) == nullptr) {
      console.info("{} is no longer forced", name_of(store, one));
      store.let_overdue_go();
    }
  }
  known_ = std::move(now);
}

}  // namespace indurop::node
