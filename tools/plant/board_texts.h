// SPDX-License-Identifier: Apache-2.0
// Texts that agents give to whoever asks for them by name, such as their history.

#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "deploy/link/deploy_link.h"

namespace indurop::tools {

// By agent, of all `agents` at the same time; within two seconds, and then without those that have not answered or do
// not have it. `self`: session of the link.
std::map<std::uint64_t, std::string> fetch_texts(deploy::DeployLink& link, std::uint64_t self, const std::string& name,
                                                 const std::vector<std::uint64_t>& agents);

}  // namespace indurop::tools
