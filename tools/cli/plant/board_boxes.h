// SPDX-License-Identifier: Apache-2.0
// Black boxes of boards in the network, as their agents list them.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "deploy/link/deploy_link.h"

namespace indurop::tools {

struct BoardBox {
  std::string board;
  std::uint64_t agent = 0;
  std::string name;  // file name
  std::string reason;
  std::uint64_t bytes = 0;
  std::int64_t end_ns = 0;  // CLOCK_REALTIME of the board
};

// Returns the black boxes of these boards, without boards that have none or do not answer within two seconds. `self`:
// session of the link.
std::vector<BoardBox> fetch_box_lists(deploy::DeployLink& link, std::uint64_t self,
                                      const std::vector<deploy::BoardReport>& boards);

// Returns the boxes of the same moment as the one that ends at `moment_ns`: the nearest one of each board, if it ends
// within ten seconds of it.
std::vector<BoardBox> boxes_of_moment(const std::vector<BoardBox>& all, std::int64_t moment_ns);

}  // namespace indurop::tools
