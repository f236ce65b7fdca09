// SPDX-License-Identifier: Apache-2.0
// Whether a network interface is fit for a fieldbus with a frame in each tick (EtherCAT).

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/rt/network_card.h"
#include "tools/cli/doctor/doctor_checks.h"

namespace indurop::tools {

struct InterfaceFacts {
  bool is_there = false;
  bool is_up = false;
  bool has_carrier = false;
  bool speaks_ipv6 = false;  // on its own: the kernel sends frames of its own
  std::string driver;        // empty: none, as of a veth pair
  rt::CardSettings card;
  std::vector<int> interrupts;
};
// Reads them from the kernel. `root` is put before /proc and /sys.
InterfaceFacts facts_of_interface(const std::string& name, const std::filesystem::path& root = "/");

// What is to be done, one finding for each thing that is wrong; one finding if all is well.
std::vector<Finding> examine_interface(const std::string& name, const InterfaceFacts& facts, bool preempt_rt);

}  // namespace indurop::tools
