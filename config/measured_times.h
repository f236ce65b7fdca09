// SPDX-License-Identifier: Apache-2.0
// How long modules executed at most in a run before, and the option --times of verbs that look at a schedule.

#pragma once

#include <map>
#include <string>

#include "base/options.h"
#include "config/check/check.h"

namespace indurop::config {

// The longest execution of each module in a report. Returns why the file is none; empty: it is one.
std::string read_measured_times(const std::string& file, CheckOptions::Times& times);

// Adds --times FILE, a report of `indurop run --report`; fills `times` when it is given. What cannot be read is a wrong
// command line.
void add_times_option(base::Options& line, CheckOptions::Times& times);

}  // namespace indurop::config
