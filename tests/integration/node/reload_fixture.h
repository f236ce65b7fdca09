// SPDX-License-Identifier: Apache-2.0
// A node whose module "counter" is exchanged: it counts its runs and those of the versions before it.

#pragma once

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "node_fixture.h"
#include "store/vars/store.h"

namespace indurop::test {

class Reload : public NodeTest {
 protected:
  static std::string built(const std::string& version) {
    return std::filesystem::path(MODULE_DIR) / ("reload_" + version + ".so");
  }
  static Module counter(const std::string& version = "same", const std::string& more = "") {
    return {.file = "reload_" + version + ".so", .name = "counter", .priority = 2, .more = more};
  }
  const Module kOther{.file = "counter.so", .name = "other", .priority = 1};
  Outcome reload(const std::vector<std::string>& words) const {
    std::vector<std::string> all = {"reload", "--node", node()};
    all.insert(all.end(), words.begin(), words.end());
    return indurop(all);
  }
  Program& start_counting(const std::string& version = "same", const std::string& more = "") {
    Program& program = start_and_wait({kOther, counter(version, more)});
    EXPECT_TRUE(runs_reach("counter", 50));
    return program;
  }
  // What the module has counted; -1: between the two values of a run.
  std::int64_t counted() const {
    const auto store = vars::Store::attach(node(), vars::Mode::ReadOnly);
    return store ? counted(*store) : -1;
  }
  static std::int64_t counted(const vars::Store& store) {
    const auto output = read<std::int32_t>(store, "nt::output");
    const auto walked = read<std::int64_t>(store, "nt::walked");
    return output != 0 && std::abs(walked) % output == 0 ? output : -1;
  }
  bool counts_up_to(std::int64_t number) {
    return wait_until([&] { return counted() >= number; });
  }
  template <class T>
  static T read(const vars::Store& store, std::string_view name) {
    T value{};
    const auto* const entry = store.find(abi::fnv1a64(name.data(), name.size()));
    EXPECT_TRUE(entry != nullptr && store.read(*entry, 0, {reinterpret_cast<std::uint8_t*>(&value), sizeof value}))
        << name;
    return value;
  }
  // No run was left out: it has counted each of them, but `lost`. All is read between two runs, so the store is
  // attached before.
  void expect_all_counted(std::int64_t lost = 0) {
    const auto& record = module("counter");
    EXPECT_EQ(record.skipped.load(), run()->lost_ticks.load());
    const auto store = vars::Store::attach(node(), vars::Mode::ReadOnly);
    ASSERT_TRUE(store.ok());
    EXPECT_TRUE(wait_until([&] {
      const auto before = static_cast<std::int64_t>(record.runs.load());
      const std::int64_t now = counted(*store);
      return now + lost == before && record.runs.load() == static_cast<std::uint64_t>(before);
    })) << counted()
        << " of " << record.runs.load();
  }
};

}  // namespace indurop::test
