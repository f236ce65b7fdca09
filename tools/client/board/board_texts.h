// SPDX-License-Identifier: Apache-2.0
// Texts that agents provide by name, such as their history.

#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "deploy/link/deploy_link.h"

namespace indurop::tools {

// Returns the texts by agent; requests them from all `agents` at the same time, waits at most two seconds, and leaves
// out those that did not answer or do not have it. `self`: session of the link.
std::map<std::uint64_t, std::string> fetch_texts(deploy::DeployLink& link, std::uint64_t self, const std::string& name,
                                                 const std::vector<std::uint64_t>& agents);

}  // namespace indurop::tools
