// SPDX-License-Identifier: Apache-2.0
// The numbers in a recording by their names: "joints[1].y" is a number in the messages of the channel "joints".

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/base/problem.h"
#include "history/recording/contents.h"
#include "history/recording/idl_layout.h"

namespace indurop::tools {

// The layouts of channels with numbers, by channel id in the file.
using Layouts = std::map<std::uint16_t, std::vector<recording::IdlLeaf>>;
Layouts layouts_of(const recording::Contents& contents);

// By channel: pairs of leaf, and index in the list of names.
using WantedNumbers = std::map<std::uint16_t, std::vector<std::pair<std::size_t, std::size_t>>>;
// Errors: a number that is not in the recording.
Result<WantedNumbers, base::Problem> find_numbers(const recording::Contents& contents, const Layouts& layouts,
                                                  const std::vector<std::string>& names);

}  // namespace indurop::tools
