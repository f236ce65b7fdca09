// SPDX-License-Identifier: Apache-2.0
// Several recordings become one on common time: those of the boards of a plant, each a folder of topics.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/problem.h"

namespace indurop::recorder {

struct Joined {
  std::uint64_t messages = 0;
  std::vector<std::string> names;  // of the boards or nodes, in the order of the files
  std::vector<std::string> gaps;   // what is missing between parts, in words
};

// Topics are NAME/TOPIC, NAME is that of the file's board, else of its node; those of a joined file are so already, and
// parts of one recording of one node alone become a recording of this node. Attachments and metadata come along, so
// named; of parts those of the last. Errors: a file cannot be read or is none of ours, or is damaged; two are of one
// board, but not parts of one recording; some are of simulations, others not; two are of simulations, but not of one
// plant; `to` is there already or cannot be written. What was begun is removed then.
Result<Joined, base::Problem> join(const std::vector<std::filesystem::path>& files, const std::filesystem::path& to);

}  // namespace indurop::recorder
