// SPDX-License-Identifier: Apache-2.0
// Messages that modules and the node printed, read from the rings of a run block: an entry stays there until it is
// reused.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scheduler/run_block.h"

namespace indurop::scheduler {

struct PrintedMessage {
  std::uint32_t module = 0;  // module_count: the node itself
  std::int64_t time_ns = 0;
  std::string text;  // without the line's end
};

// Returns the newest `most` messages, oldest first. `module_count` and `size` (bytes of the block) were checked by the
// caller; rings outside the block are left out, and so are messages printed during the call. Only reads; not real-time
// safe.
std::vector<PrintedMessage> printed_messages(const RunBlock& block, std::uint64_t size, std::uint32_t module_count,
                                             std::size_t most);

}  // namespace indurop::scheduler
