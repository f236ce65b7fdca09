// SPDX-License-Identifier: Apache-2.0
// The option --times of verbs that look at a schedule.

#pragma once

#include "base/options.h"
#include "config/check/check.h"

namespace indurop::config {

// Adds --times FILE, a report of `indurop run --report`; fills `times` when it is given. What cannot be read is a wrong
// command line.
void add_times_option(base::Options& line, CheckOptions::Times& times);

}  // namespace indurop::config
