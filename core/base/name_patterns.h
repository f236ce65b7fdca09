// SPDX-License-Identifier: Apache-2.0
// Patterns over names that limit what a user may change: '*' stands for any characters, as in a shell.

#pragma once

#include <string>
#include <vector>

namespace indurop::base {

// Returns true if there are no patterns, or one of them matches the whole name.
bool matches_any(const std::vector<std::string>& patterns, const std::string& name);
// The same for a variable or a part of it, "knu::Robot::joints[1].y": a pattern may stand for either.
bool matches_any_variable(const std::vector<std::string>& patterns, const std::string& name);

}  // namespace indurop::base
