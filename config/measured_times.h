// SPDX-License-Identifier: Apache-2.0
// The option --times of verbs that compute a schedule.

#pragma once

#include "config/check/check.h"
#include "core/base/options.h"

namespace indurop::config {

// Adds --times FILE, a report of `indurop run --report`; fills `times` when the option is given. An unreadable file is
// a command line error.
void add_times_option(base::Options& line, CheckOptions::Times& times);

}  // namespace indurop::config
