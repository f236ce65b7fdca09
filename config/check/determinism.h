// SPDX-License-Identifier: Apache-2.0
// Checks from a module's imported symbols whether its runs are repeatable.

#pragma once

#include <string>
#include <vector>

namespace indurop::config {

// Returns the system calls and functions that make a module's runs differ, from the symbols it imports: "real time
// (clock_gettime, time)". Empty: no known ones. Libraries that it links are not examined.
std::vector<std::string> sources_of_chance(const std::vector<std::string>& imports);

// Returns true if the module communicates other than through shared variables, so that it may move something. Judged by
// its imported symbols.
bool talks_to_others(const std::vector<std::string>& imports);

}  // namespace indurop::config
