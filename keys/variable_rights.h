// SPDX-License-Identifier: Apache-2.0
// Which variables a tool may read and set: lists of patterns, the file they are kept in, and the topics they mean.

#pragma once

#include <indurop/result.h>

#include <filesystem>
#include <string>
#include <vector>

#include "base/problem.h"

namespace indurop::keys {

struct VariableRights {
  std::vector<std::string> read;   // patterns over full names: "station::*"
  std::vector<std::string> write;  // what may be set may also be read
};

// "a::*,b::c" as a list; blanks around the commas do not count.
std::vector<std::string> pattern_list(const std::string& text);
// What is wrong with a pattern; empty: nothing.
std::string pattern_problem(const std::string& pattern);

// One line each: "read station::*".
std::string rights_text(const VariableRights& rights);
Result<VariableRights, base::Problem> read_rights(const std::filesystem::path& file);

// The topics of such variables, under their own names and under those of ROS 2.
std::vector<std::string> variable_topics(const std::vector<std::string>& patterns);

}  // namespace indurop::keys
