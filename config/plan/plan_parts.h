// SPDX-License-Identifier: Apache-2.0
// Functions that all forms of the plan use.

#pragma once

#include <string>
#include <vector>

#include "config/plan/plan.h"

namespace indurop::config {

// Returns the module names of one slot in execution order.
std::vector<std::string> names_of(const Config& config, const CheckResult& check, const scheduler::Slot& slot);
// "cntr3 > cntr2"
std::string in_order(const std::vector<std::string>& names);
// Returns the core of a module; -1: the node chooses it.
int core_of(const Config& config, const Module& module);
// Returns the modules that must end their run of a basic period before this one starts, if they are due in it and run
// on another core.
std::vector<std::size_t> waited_for(const Config& config, const CheckResult& check, std::size_t module);
// Returns the deadline, or else the period, minus the worst-case response; 0 if the response is not known or there is
// no deadline.
base::Nanos slack_of(const Module& module, const Timing& timing);
// Returns the share of a core used by modules with a known execution time; sporadic ones count once per deadline.
double utilisation(const Module& module);
double utilisation(const Config& config);
// Returns nanoseconds as milliseconds with all digits: "0.1".
std::string milliseconds(base::Nanos value);

}  // namespace indurop::config
