// SPDX-License-Identifier: Apache-2.0
// The values that a module's configuration declares for its faults: resolved before the run, written by the thread that
// notices the fault.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "config/model/config.h"
#include "store/vars/store.h"

namespace indurop::node {

class FailSafe {
 public:
  // Values that do not resolve are left out: check_config has rejected them before. Not real-time safe.
  FailSafe(vars::Store& store, const config::Config& config);
  // Adds a module: the index of the next one.
  void add(const config::Module& module);
  // Writes all values of the module. Real-time safe.
  void apply(std::size_t module) noexcept;

 private:
  struct Write {
    vars::DirectoryEntry variable;
    std::uint32_t offset;
    std::vector<std::uint8_t> bytes;
  };
  vars::Store& store_;
  std::vector<std::vector<Write>> writes_;  // per module; never moved
};

}  // namespace indurop::node
