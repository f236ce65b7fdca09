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
  // Writes all values of the module. Real-time safe.
  void apply(std::size_t module) noexcept;

 private:
  struct Write {
    const vars::DirectoryEntry* variable;
    std::uint32_t offset;
    std::vector<std::uint8_t> bytes;
  };
  vars::Store& store_;
  std::vector<std::vector<Write>> writes_;  // per module
};

}  // namespace indurop::node
