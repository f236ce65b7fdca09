// SPDX-License-Identifier: Apache-2.0
// A /dev/shm and a state directory of the test's own, `indurop` run in it, and fake nodes.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/program.h"

namespace indurop::test {

// Gives this process a private, empty /dev/shm, an empty one again at each further call. False if the system does not
// allow that.
bool enter_sandbox();

// Folder for this process's files, removed at its end; $INDUROP_STATE_DIR of all programs run lies in it.
std::filesystem::path scratch();

// Runs `indurop` with these arguments to its end.
Outcome indurop(const std::vector<std::string>& arguments, Environment environment = {});

// For programs in the background: what they say comes with what they print.
Environment background();

std::vector<std::string> fake_node(const std::string& name, const std::vector<std::string>& more = {});
std::vector<std::string> indurop_command(const std::vector<std::string>& arguments);

}  // namespace indurop::test
