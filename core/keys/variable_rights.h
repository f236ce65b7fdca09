// SPDX-License-Identifier: Apache-2.0
// The variables that a tool may read and set: lists of patterns, the file that stores them, and the topics they refer
// to.

#pragma once

#include <indurop/result.h>

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/problem.h"

namespace indurop::keys {

struct VariableRights {
  std::vector<std::string> read;   // patterns over full names: "station::*"
  std::vector<std::string> write;  // variables that may be set may also be read
};

// Returns "a::*,b::c" as a list; blanks around the commas are ignored.
std::vector<std::string> pattern_list(const std::string& text);
// Returns the error in a pattern; empty if it is valid.
std::string pattern_problem(const std::string& pattern);

// Returns one line for each pattern: "read station::*".
std::string rights_text(const VariableRights& rights);
Result<VariableRights, base::Problem> read_rights(const std::filesystem::path& file);

// Returns the topics of the variables that match, under their own names and under those of ROS 2.
std::vector<std::string> variable_topics(const std::vector<std::string>& patterns);

}  // namespace indurop::keys
