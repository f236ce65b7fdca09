// SPDX-License-Identifier: Apache-2.0
// What is known for `indurop explain`: of a node of this machine, or of the recording of one.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/problem.h"
#include "explain/facts.h"
#include "tools/command/verb.h"
#include "tools/values/node_choice.h"

namespace indurop::tools {

// A node and a variable of which more is known: when it changed. Empty: none.
explain::Facts facts_here(const ChosenRun& chosen, const std::string& variable);

// What the node says beside its runs and values, as a text for its recording.
std::string facts_text_here(const std::string& node, const RunView& run);

// Of each node that the recording tells of. Errors: no recording of a node.
Result<std::vector<explain::Facts>, base::Problem> facts_recorded(const std::filesystem::path& file,
                                                                  const std::string& variable);

// Of two recordings of one board, which may contradict each other, neither is taken.
std::string two_recordings(const std::string& board, const std::string& file);

// Adds what module.xml or plant.xml says: who writes what, who waits for whom. Nothing if it cannot be read.
void add_config(const std::string& config, explain::Facts& facts);

}  // namespace indurop::tools
