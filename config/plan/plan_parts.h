// SPDX-License-Identifier: Apache-2.0
// What all forms of the plan need from configuration and check.

#pragma once

#include <string>
#include <vector>

#include "config/plan/plan.h"

namespace indurop::config {

// Module names of one slot in execution order.
std::vector<std::string> names_of(const Config& config, const CheckResult& check, const scheduler::Slot& slot);
// "cntr3 > cntr2"
std::string in_order(const std::vector<std::string>& names);
// -1: the one the node chooses.
int core_of(const Config& config, const Module& module);
// Modules that have to be done with a basic period before this one begins it, if they are due in it and elsewhere.
std::vector<std::size_t> waited_for(const Config& config, const CheckResult& check, std::size_t module);
// Deadline, else period, less the worst response; 0 if that is not known, or there is none.
base::Nanos slack_of(const Module& module, const Timing& timing);
// Share of a core that modules take which say how long they execute; sporadic ones once within their deadline.
double utilisation(const Module& module);
double utilisation(const Config& config);
// Nanoseconds as milliseconds, every digit: "0.1".
std::string milliseconds(base::Nanos value);

}  // namespace indurop::config
