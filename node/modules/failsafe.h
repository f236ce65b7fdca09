// SPDX-License-Identifier: Apache-2.0
// The values that a module's configuration declares for its faults: resolved before the run, written by the thread that
// notices the fault.

#pragma once

#include <cstdint>
#include <functional>
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
  // The same without the variables, by the hashes of their names, that others write from now on. Not real-time safe.
  void apply_except(std::size_t module, const std::function<bool(std::uint64_t)>& is_written_by_others);

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
