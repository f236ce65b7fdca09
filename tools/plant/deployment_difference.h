// SPDX-License-Identifier: Apache-2.0
// What differs between two deployments: their files, and the lines of those that are text.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/json.h"
#include "base/problem.h"
#include "deploy/link/deploy_link.h"

namespace indurop::tools {

// As agents of boards have them: {"files": [{"path", "change": "added", "removed", "changed", "size_before",
// "size_after", "lines": [{"change": "added", "removed" or "same", "text"}]}]}; `lines` of text files up to 60 kB, what
// is the same but for three lines around a change left out. A problem if no agent has a package. Takes some seconds.
Result<base::Json, base::Problem> difference_of(deploy::DeployLink& link, std::uint64_t self,
                                                const std::vector<std::uint64_t>& agents, const std::string& before,
                                                const std::string& after);

// The same of two texts, line by line.
base::Json lines_between(const std::string& before, const std::string& after);

}  // namespace indurop::tools
