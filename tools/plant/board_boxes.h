// SPDX-License-Identifier: Apache-2.0
// Black boxes of boards in the network, as their agents show and give them.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "deploy/link/deploy_link.h"

namespace indurop::tools {

struct BoardBox {
  std::string board;
  std::uint64_t agent = 0;
  std::string name;  // of the file
  std::string reason;
  std::uint64_t bytes = 0;
  std::int64_t end_ns = 0;  // CLOCK_REALTIME of the board
};

// Of all these boards; of those that do not answer within two seconds, or have none, nothing. `self`: session of the
// link.
std::vector<BoardBox> fetch_box_lists(deploy::DeployLink& link, std::uint64_t self,
                                      const std::vector<deploy::BoardReport>& boards);

// The boxes that tell of the same moment as the one that ends at `moment_ns`: of each board the nearest, if it ends
// within ten seconds of it.
std::vector<BoardBox> boxes_of_moment(const std::vector<BoardBox>& all, std::int64_t moment_ns);

}  // namespace indurop::tools
