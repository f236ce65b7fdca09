// SPDX-License-Identifier: Apache-2.0
// How long modules executed at most in a run before, from its report.

#pragma once

#include <string>

#include "config/check/check.h"

namespace indurop::config {

// The longest execution of each module in a report. Returns why the file is none; empty: it is one.
std::string read_measured_times(const std::string& file, CheckOptions::Times& times);

}  // namespace indurop::config
