// SPDX-License-Identifier: Apache-2.0
// Does a module do the same on every run.

#pragma once

#include <string>
#include <vector>

namespace indurop::config {

// What of the system makes a module's runs differ, by the symbols it imports: "real time (clock_gettime, time)". Empty:
// nothing that is known. What libraries do that it links is not seen.
std::vector<std::string> sources_of_chance(const std::vector<std::string>& imports);

// Whether it speaks to the world beyond the shared variables: it may move something there. By its symbols too.
bool talks_to_others(const std::vector<std::string>& imports);

}  // namespace indurop::config
