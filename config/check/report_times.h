// SPDX-License-Identifier: Apache-2.0
// The longest execution times of modules in an earlier run, from its report.

#pragma once

#include <string>

#include "config/check/check.h"

namespace indurop::config {

// Reads the longest execution of each module from a report. Returns why the file is not a report; empty on success.
std::string read_measured_times(const std::string& file, CheckOptions::Times& times);

}  // namespace indurop::config
