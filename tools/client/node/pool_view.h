// SPDX-License-Identifier: Apache-2.0
// The pools of a node on this machine: chunks, drops and users.

#pragma once

#include <string>
#include <vector>

#include "store/pools/pool.h"
#include "store/vars/store.h"
#include "tools/client/text/table.h"

namespace indurop::tools {

struct PoolView {
  pools::Shape shape;
  std::string type;  // of a chunk
  pools::Usage usage;
  std::int64_t newest_age_ns = -1;  // -1: nothing was published yet
};

// Returns those of the pools that the node declares whose name matches `pattern`, and that exist.
std::vector<PoolView> view_pools(const std::string& node, const vars::Store& store, std::string_view pattern = "*");
// One line about the pool, then one for each user.
std::vector<std::string> lines_of(const PoolView& view);
JsonValue json_of(const std::vector<PoolView>& views);

}  // namespace indurop::tools
