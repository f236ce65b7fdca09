// SPDX-License-Identifier: Apache-2.0
// The difference between two deployments: their files, and the lines of text files.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/json.h"
#include "core/base/problem.h"
#include "deploy/link/deploy_link.h"

namespace indurop::tools {

// Returns the difference of two deployments that agents of boards have: {"files": [{"path", "change": "added",
// "removed", "changed", "size_before", "size_after", "lines": [{"change": "added", "removed" or "same", "text"}]}]};
// `lines` for text files up to 60 kB, with three unchanged lines around a change. A problem if no agent has a package.
// Takes some seconds.
Result<base::Json, base::Problem> difference_of(deploy::DeployLink& link, std::uint64_t self,
                                                const std::vector<std::uint64_t>& agents, const std::string& before,
                                                const std::string& after);

// Returns the same for two texts, line by line.
base::Json lines_between(const std::string& before, const std::string& after);

}  // namespace indurop::tools
