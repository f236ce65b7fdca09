// SPDX-License-Identifier: Apache-2.0
#include "explain/run_facts.h"

#include <algorithm>
#include <atomic>
#include <cstring>

#include "scheduler/words.h"

namespace indurop::explain {
namespace {

template <std::size_t N>
std::string text_of(const char (&text)[N]) {
  return {text, ::strnlen(text, N)};
}

// Entries that are whole before and after the copy, oldest first.
template <class Entry, class Take>
void each(const Entry* ring, std::uint64_t capacity, std::uint64_t next, Take take) {
  const std::uint64_t count = std::min(capacity, next);
  for (std::uint64_t number = next - count; number < next; ++number) {
    const Entry& entry = ring[number % capacity];
    if (entry.sequence.load(std::memory_order_acquire) != number + 1) {
      continue;
    }
    const auto fact = take(entry);
    std::atomic_thread_fence(std::memory_order_acquire);
    if (entry.sequence.load(std::memory_order_relaxed) == number + 1) {
      fact();
    }
  }
}

ModuleFact fact_of(const scheduler::ModuleRecord& record) {
  ModuleFact fact;
  fact.name = text_of(record.name);
  fact.type = to_text(record.type);
  fact.operation = to_text(record.operation);
  fact.period_ns = record.period_ns;
  fact.offset_ns = record.offset_ns;
  fact.deadline_ns = record.deadline_ns;
  fact.priority = record.priority;
  fact.core = record.core;
  fact.fifo_priority = record.fifo_priority;
  fact.state = to_text(record.state.load(std::memory_order_acquire));
  fact.runs = record.runs.load();
  fact.faults = record.faults.load();
  fact.restarts = record.restarts.load();
  if (record.fault_kind.load(std::memory_order_acquire) != 0) {
    fact.fault_tick = record.fault_tick.load();
    fact.fault = text_of(record.last_fault);
  }
  return fact;
}

}  // namespace

Facts facts_of(const scheduler::RunBlock& block, bool with_runs) {
  Facts facts;
  facts.node = text_of(block.node_name);
  facts.is_virtual = block.virtual_ns.load() != 0;
  facts.realtime = block.obtained.fifo != 0;
  facts.basic_period_ns = block.basic_period_ns;
  facts.epoch_ns = block.epoch_ns;
  facts.tick = block.tick.load();
  facts.lost_ticks = block.lost_ticks.load();
  facts.stop_reason = text_of(block.stop_reason);
  for (std::uint32_t i = 0; i < block.module_count; ++i) {
    facts.modules.push_back(fact_of(block.modules()[i]));
  }
  each(block.at<scheduler::OverrunEntry>(block.overrun_log_offset), block.overrun_log_capacity,
       block.overrun_log_next.load(std::memory_order_acquire), [&](const scheduler::OverrunEntry& entry) {
         const OverrunFact fact{entry.module, entry.tick, entry.own_ns, entry.started != 0};
         return [&facts, fact] { facts.overruns.push_back(fact); };
       });
  if (!with_runs) {
    return facts;
  }
  const std::uint64_t next = block.slot_log_next.load(std::memory_order_acquire);
  each(block.at<scheduler::SlotEntry>(block.slot_log_offset), block.slot_log_capacity, next,
       [&](const scheduler::SlotEntry& entry) {
         const RunFact fact{entry.module, entry.tick, entry.release_ns, entry.start_ns, entry.end_ns, false};
         return [&facts, fact] { facts.runs.push_back(fact); };
       });
  std::erase_if(facts.runs, [&](const RunFact& run) { return run.module >= facts.modules.size(); });
  // Of the first tick in the log some runs may be gone already.
  if (next > block.slot_log_capacity && !facts.runs.empty()) {
    facts.first_tick = facts.runs.front().tick + 1;
  }
  for (RunFact& run : facts.runs) {
    const ModuleFact& module = facts.modules[run.module];
    run.faulted = module.faults > 0 && module.fault_tick == run.tick && !module.fault.empty();
  }
  std::stable_sort(facts.runs.begin(), facts.runs.end(),
                   [](const RunFact& a, const RunFact& b) { return a.start_ns < b.start_ns; });
  return facts;
}

void add_boards(const mirror::MirrorBlock& mirror, Facts& facts) {
  facts.board = text_of(mirror.board);
  for (std::uint32_t i = 0; i < mirror.peer_count; ++i) {
    const mirror::PeerRecord& peer = mirror.peers()[i];
    BoardFact fact;
    fact.name = text_of(peer.name);
    fact.state = to_text(peer.state.load());
    fact.problem = peer.problem.get();
    fact.heard_ns = peer.heard_ns.load();
    fact.losses = peer.losses.load();
    fact.lost_updates = peer.lost_updates.load();
    facts.boards.push_back(std::move(fact));
  }
}

}  // namespace indurop::explain
