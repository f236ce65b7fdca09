// SPDX-License-Identifier: Apache-2.0
// Reports in the node's log which variables are forced and which no longer are, and releases forces that have expired.
// Not for the real-time path.

#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "node/run/console.h"
#include "store/vars/store.h"

namespace indurop::node {

class ForceWatch {
 public:
  explicit ForceWatch(std::string node) : node_(std::move(node)) {}

  // A lease is reported once, not each time its client renews it.
  void report_changes(vars::Store& store, Console& console);

 private:
  struct Known {
    vars::Force force;    // its variable is valid in the next call only if the store has not grown
    std::uint64_t place;  // of the variable in the store
    std::string name;
    bool lease = false;  // it ends unless its client renews it
    [[nodiscard]] bool is_of(const vars::Force& other) const noexcept {
      return place == other.variable->offset && force.offset == other.offset;
    }
  };

  [[nodiscard]] bool is_lease(const vars::Force& force) const;
  static std::string time_of(const Known& known, rt::MonoTime now);

  std::string node_;
  std::vector<Known> known_;
};

}  // namespace indurop::node
