// SPDX-License-Identifier: Apache-2.0
// What was sent, received and dropped, for people and for programs.

#pragma once

#include <string>

#include "doors/pools/counts.h"
#include "tools/client/text/table.h"

namespace indurop::pool_door {

std::string line_of(const std::string& pool, const SendCounts& counts);
std::string line_of(const std::string& pool, const ReceiveCounts& counts);
tools::JsonValue json_of(const std::string& pool, const SendCounts& counts);
tools::JsonValue json_of(const std::string& pool, const ReceiveCounts& counts);

}  // namespace indurop::pool_door
