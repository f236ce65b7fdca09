// SPDX-License-Identifier: Apache-2.0
#include "history/explain/run_facts.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <iterator>
#include <span>

#include "scheduler/words.h"

namespace indurop::explain {
namespace {

template <std::size_t N>
std::string text_of(const char (&text)[N]) {
  return {text, ::strnlen(text, N)};
}

// Returns `count` objects of the block if all of them are within `size` bytes, else none.
template <class T>
std::span<const T> inside(const scheduler::RunBlock& block, std::uint64_t size, std::uint64_t offset,
                          std::uint64_t count) {
  const bool good =
      offset >= sizeof block && offset % alignof(T) == 0 && offset <= size && count <= (size - offset) / sizeof(T);
  return good ? std::span(block.at<T>(offset), count) : std::span<const T>();
}

// Visits the entries that are valid before and after the copy, oldest first.
template <class Entry, class Take>
void each(std::span<const Entry> ring, std::uint64_t next, Take take) {
  const std::uint64_t count = std::min<std::uint64_t>(ring.size(), next);
  for (std::uint64_t number = next - count; number < next; ++number) {
    const Entry& entry = ring[number % ring.size()];
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

void make_sound(Facts& facts) noexcept {
  static constexpr std::int64_t kTimeLimit = std::int64_t{1} << 60U;
  constexpr std::int64_t kLongestPeriod = 1'000'000'000'000;
  std::int64_t& basic = facts.basic_period_ns;
  basic = basic < 0 || basic > kLongestPeriod ? 0 : basic;
  const std::uint64_t last = static_cast<std::uint64_t>(kTimeLimit / std::max<std::int64_t>(basic, 1));
  const auto times = [](auto&... all) { ((all = std::clamp<std::int64_t>(all, -kTimeLimit, kTimeLimit)), ...); };
  const auto durations = [](auto&... all) { ((all = std::clamp<std::int64_t>(all, 0, kTimeLimit)), ...); };
  const auto ticks = [last](auto&... all) { ((all = std::min(all, last)), ...); };
  times(facts.epoch_ns, facts.now_ns, facts.kernel_from_ns, facts.kernel_to_ns);
  durations(facts.lease_ns);
  ticks(facts.tick, facts.first_tick, facts.schedule_tick);
  for (ModuleFact& module : facts.modules) {
    durations(module.period_ns, module.offset_ns, module.deadline_ns);
    ticks(module.fault_tick);
  }
  for (RunFact& run : facts.runs) {
    times(run.release_ns, run.start_ns, run.end_ns);
    ticks(run.tick);
  }
  for (OverrunFact& overrun : facts.overruns) {
    times(overrun.own_ns);
    ticks(overrun.tick);
  }
  for (KernelFact& fact : facts.kernel) {
    times(fact.from_ns, fact.to_ns, fact.waited_ns, fact.stolen_ns);
  }
  for (BoardFact& board : facts.boards) {
    times(board.heard_ns);
  }
}

Facts facts_of(const scheduler::RunBlock& block, std::uint64_t size, bool with_runs) {
  // Each number is read once, then checked: it may change meanwhile.
  const auto modules = inside<scheduler::ModuleRecord>(block, size, block.modules_offset, block.module_count);
  const auto overruns =
      inside<scheduler::OverrunEntry>(block, size, block.overrun_log_offset, block.overrun_log_capacity);
  const auto slots = inside<scheduler::SlotEntry>(block, size, block.slot_log_offset, block.slot_log_capacity);
  Facts facts;
  facts.node = text_of(block.node_name);
  facts.is_virtual = block.virtual_ns.load() != 0;
  facts.realtime = block.obtained.fifo != 0;
  facts.basic_period_ns = std::max<std::int64_t>(block.basic_period_ns, 0);
  facts.epoch_ns = block.epoch_ns;
  facts.tick = block.tick.load();
  facts.lost_ticks = block.lost_ticks.load();
  facts.schedule = block.schedule.load(std::memory_order_acquire);
  facts.schedule_tick = block.schedule_tick.load();
  facts.stop_reason = text_of(block.stop_reason);
  std::transform(modules.begin(), modules.end(), std::back_inserter(facts.modules), fact_of);
  each(overruns, block.overrun_log_next.load(std::memory_order_acquire), [&](const scheduler::OverrunEntry& entry) {
    const OverrunFact fact{entry.module, entry.tick, entry.own_ns, entry.started != 0};
    return [&facts, fact] { facts.overruns.push_back(fact); };
  });
  std::erase_if(facts.overruns, [&](const OverrunFact& one) { return one.module >= facts.modules.size(); });
  if (!with_runs) {
    make_sound(facts);
    return facts;
  }
  const std::uint64_t next = block.slot_log_next.load(std::memory_order_acquire);
  each(slots, next, [&](const scheduler::SlotEntry& entry) {
    const RunFact fact{entry.module, entry.tick, entry.release_ns, entry.start_ns, entry.end_ns, false};
    return [&facts, fact] { facts.runs.push_back(fact); };
  });
  std::erase_if(facts.runs, [&](const RunFact& run) { return run.module >= facts.modules.size(); });
  // Some runs of the first tick in the log may be gone already.
  if (next > slots.size() && !facts.runs.empty()) {
    facts.first_tick = facts.runs.front().tick + 1;
  }
  make_sound(facts);
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
