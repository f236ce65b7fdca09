// SPDX-License-Identifier: Apache-2.0
// Orders to a running node about one of its modules, through the module's record in the run block: whoever may write
// the block places one, the node carries it out beside the schedule and answers. No files here.

#pragma once

#include <cstdint>
#include <optional>

#include "scheduler/run_block.h"

namespace indurop::scheduler {

enum class ModuleOrder : std::uint8_t { None, Stop, Start, Restart };
enum class OrderResult : std::uint8_t {
  None,       // not answered yet
  Done,       // the module is as it was ordered to be
  Unchanged,  // it was so before
  Failed,     // it is not; ModuleRecord::last_fault or the node's own words tell why
  Ending,     // the node itself stops
};

// What a ticket stands for; the next order gets another one.
using OrderTicket = std::uint64_t;

// Nothing while an earlier order of the module is not answered yet. Any process, any thread.
std::optional<OrderTicket> place_order(ModuleRecord& record, ModuleOrder order) noexcept;
// None while the node is at it. Of an order that was followed by another one only Done is known.
OrderResult result_of(const ModuleRecord& record, OrderTicket ticket) noexcept;

// For the node: the order that waits for an answer, and the answer.
ModuleOrder waiting_order(const ModuleRecord& record) noexcept;
void answer_order(ModuleRecord& record, OrderResult result) noexcept;

}  // namespace indurop::scheduler
