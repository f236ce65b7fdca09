// SPDX-License-Identifier: Apache-2.0
// Collects facts for `indurop explain` from a node of this machine, or from a recording.

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "core/schema/schema.h"
#include "history/explain/facts.h"
#include "tools/cli/command/verb.h"
#include "tools/client/node/node_choice.h"

namespace indurop::tools {

// Facts of a local node. `variable`: one for which the times of its changes are added; empty: none.
explain::Facts facts_here(const ChosenRun& chosen, const std::string& variable);

// Facts of the node other than its runs and values, as a text for its recording.
std::string facts_text_here(const std::string& node, const RunView& run);

// Facts of each node in the recording. Errors: it is not a recording of a node.
Result<std::vector<explain::Facts>, base::Problem> facts_recorded(const std::filesystem::path& file,
                                                                  const std::string& variable);

// The message that two recordings of one board, which may contradict each other, are rejected.
std::string two_recordings(const std::string& board, const std::string& file);

// Where a field device's quality is.
struct QualityPlace {
  std::size_t device = 0;  // index into Facts::devices
  std::string variable;    // whole name
  schema::Type type;       // a number
  std::uint32_t offset = 0;

  // Adds the quality to the facts if it has changed. `value`: the variable's.
  void add(std::int64_t time_ns, std::span<const std::uint8_t> value, explain::Facts& facts) const;
};

// Adds facts from module.xml or plant.xml: who writes what, who waits for whom, which field devices there are. Adds
// nothing if the file cannot be read. Returns where the qualities of these devices are.
std::vector<QualityPlace> add_config(const std::string& config, explain::Facts& facts);

}  // namespace indurop::tools
