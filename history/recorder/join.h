// SPDX-License-Identifier: Apache-2.0
// Joins several recordings to one with a common time: those of the boards of a plant, each with its own topic prefix.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/problem.h"

namespace indurop::recorder {

struct Joined {
  std::uint64_t messages = 0;
  std::vector<std::string> names;  // names of the boards or nodes, in the order of the files
  std::vector<std::string> gaps;   // descriptions of what is missing between parts
};

// Topics become NAME/TOPIC, where NAME is the file's board, else its node; topics of a joined file have that form
// already, and parts of one recording of a single node become a recording of this node. Attachments and metadata are
// copied, with names of the same form; of parts, those of the last. Errors: a file cannot be read, is no InduRoP
// recording, or is damaged; two are of one board, but not parts of one recording; some are of simulations, others not;
// two are of simulations, but not of one plant; `to` exists already or cannot be written. A partial `to` is removed
// then.
Result<Joined, base::Problem> join(const std::vector<std::filesystem::path>& files, const std::filesystem::path& to);

}  // namespace indurop::recorder
