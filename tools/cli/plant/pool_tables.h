// SPDX-License-Identifier: Apache-2.0
// The pools of a configuration or a plant as tables: what is declared, and between which boards it is sent.

#pragma once

#include "tools/client/config/checked_config.h"
#include "tools/client/text/table.h"

namespace indurop::tools {

Table pool_table(const CheckedConfig& checked);
Table pool_table(const CheckedPlant& checked);
// Those that match one of the globs (all if there are none), and whose type matches `type`, if it is not empty.
Table pool_table(const schema::Schema& schema, const std::vector<std::string>& globs, const std::string& type);
// ", 2 pools"; empty if there is none.
std::string counted_pools(std::size_t number);

}  // namespace indurop::tools
