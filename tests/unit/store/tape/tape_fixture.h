// SPDX-License-Identifier: Apache-2.0
// A store with a few variables, and a tape of it.

#pragma once

#include <gmock/gmock.h>

#include <memory>
#include <string>
#include <vector>

#include "store/tape/follower.h"
#include "store/tape/tape.h"
#include "store/vars/store.h"
#include "tests/unit/store/vars/test_schema.h"

namespace indurop::tape::test {

using vars::test::array_type;
using vars::test::bytes_of;
using vars::test::scalar_type;
using vars::test::variable;

// a, b, c: scalars of 1, 4 and 8 bytes; d: 30 doubles; e: 5 bytes.
inline schema::Schema five() {
  schema::Schema schema;
  schema.variables.push_back(variable("a", scalar_type(schema::Base::UInt8)));
  schema.variables.push_back(variable("b", scalar_type(schema::Base::UInt32)));
  schema.variables.push_back(variable("c", scalar_type(schema::Base::Double)));
  schema.variables.push_back(variable("d", array_type(schema::Base::Double, 30)));
  schema.variables.push_back(variable("e", array_type(schema::Base::UInt8, 5)));
  schema.variables[1].initial = bytes_of<std::uint32_t>(7);
  return schema;
}

class Plant {
 public:
  explicit Plant(const std::string& label, const std::vector<std::pair<std::string, std::string>>& modules,
                 std::uint64_t bytes = 1'000'000)
      : node_(label), store_(vars::Store::create(node_.name(), five()).value()) {
    std::vector<ModuleAccess> accesses;
    for (const auto& [reads, writes] : modules) {
      ModuleAccess access{static_cast<std::uint32_t>(accesses.size()), 1'000'000, {}, {}};
      for (const char name : reads) {
        access.reads.push_back(index(std::string(1, name)));
      }
      for (const char name : writes) {
        access.writes.push_back(index(std::string(1, name)));
      }
      accesses.push_back(access);
    }
    const TapePlan plan = plan_tape(accesses, store_.directory(), 1'000'000, 100'000'000, bytes);
    auto made = Tape::create(node_.name(), store_, plan, modules.size());
    EXPECT_TRUE(made.ok());
    tape_ = std::move(made).value();
  }

  [[nodiscard]] const std::string& node() const { return node_.name(); }
  vars::Store& store() { return store_; }
  Track& track(std::uint32_t module) { return *tape_->of(module); }
  Tape& tape() { return *tape_; }
  Track& others() { return *tape_->others(); }
  Follower follow(bool from_start = true) { return Follower::open(node_.name(), from_start).value(); }

  std::uint32_t index(const std::string& name) {
    return static_cast<std::uint32_t>(store_.find(vars::test::hash(name)) - store_.directory().data());
  }
  template <class T>
  void put(const std::string& name, const T& value, std::uint32_t offset = 0) {
    EXPECT_TRUE(store_.write(store_.directory()[index(name)], offset, bytes_of(value)).ok());
  }
  std::vector<std::uint8_t> bytes(const std::string& name) {
    const vars::DirectoryEntry& entry = store_.directory()[index(name)];
    std::vector<std::uint8_t> bytes(entry.value_size);
    EXPECT_TRUE(store_.read(entry, 0, bytes).ok());
    return bytes;
  }
  static RunTail at(std::uint64_t tick) {
    const auto ns = static_cast<std::int64_t>(tick) * 1'000'000;
    return {0, 0, tick, ns, ns + 5, ns + 9};
  }

 private:
  vars::test::TestNode node_;
  vars::Store store_;
  std::unique_ptr<Tape> tape_;
};

}  // namespace indurop::tape::test
