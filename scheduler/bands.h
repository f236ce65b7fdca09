// SPDX-License-Identifier: Apache-2.0
// Bands: longest sequences of neighbours in priority order that are released together and executed one after the other
// by one thread. Fewer threads and wake-ups than one per module, same order as Table 3. Pure arithmetic.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scheduler/core_order.h"
#include "scheduler/task.h"

namespace indurop::scheduler {

enum class BandKind {
  Inline,     // runs in the core's tick thread: the top band, if it is released in every basic period
  AfterBase,  // in the same thread, directly after Inline on the primary core: sporadic modules that must not wait
  Thread,     // one FIFO thread
  Process,    // one process module
  Handler,    // the event handler: sporadic modules, after everything periodic
};

// Such a band has no thread of its own and never waits: it is done before its core's tick thread releases the others.
constexpr bool in_tick_thread(BandKind kind) noexcept {
  return kind == BandKind::Inline || kind == BandKind::AfterBase;
}

struct BandPlan {
  BandKind kind = BandKind::Thread;
  int core = 0;
  int fifo_priority = 0;
  std::int64_t period_ns = 0;
  std::int64_t offset_ns = 0;
  OverrunPolicy overrun = OverrunPolicy::Skip;
  std::vector<std::uint32_t> tasks;  // indices into the input, in execution order
};

inline constexpr int kWatchdogPriority = 99;
inline constexpr int kTickPriority = 90;
inline constexpr int kServicePriority = 89;    // servers of shared functions
inline constexpr int kTopBandPriority = 88;    // further bands count down from this
inline constexpr int kLowestBandPriority = 4;  // event handler and sporadic processes need the levels below
inline constexpr int kHandlerPriority = 3;
inline constexpr int kSporadicProcessPriority = 2;
inline constexpr int kMirrorPriority = 1;

// Makes the bands of the periodic tasks, in the execution order of their first tasks. Uses one FIFO level per band and
// core. CoreOrder::Data: neighbours on one core, whatever runs on other cores between them; a band begins with a task
// that waits for one of another core, and ends with one that such a task waits for, so bands never wait in a circle.
// A band runs inline if it is the first on its core, has the basic period and no offset, consists of thread modules,
// and no band of another core has to run before it in the same tick.
std::vector<BandPlan> make_bands(std::span<const Task> periodic, std::int64_t basic_period_ns,
                                 CoreOrder order = CoreOrder::Total);

}  // namespace indurop::scheduler
