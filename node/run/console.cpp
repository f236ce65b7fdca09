// SPDX-License-Identifier: Apache-2.0
#include "node/run/console.h"

#include <algorithm>
#include <cstddef>
#include <cstdio>

#include "core/base/printable.h"
#include "core/base/standard_files.h"

namespace indurop::node {
namespace {

using std::chrono::milliseconds;

constexpr std::chrono::seconds kSummary{1};
constexpr std::size_t kMaxLines = 4;

double in_microseconds(std::int64_t ns) noexcept {
  return static_cast<double>(ns) / 1000;
}

// Returns the newest record of an overrun of `module`, null if it was overwritten.
const scheduler::OverrunEntry* newest_overrun(const scheduler::RunBlock& run, std::uint32_t module) {
  const auto* entries = run.at<scheduler::OverrunEntry>(run.overrun_log_offset);
  const std::uint64_t next = run.overrun_log_next.load(std::memory_order_acquire);
  for (std::uint64_t back = 1; back <= run.overrun_log_capacity && back <= next; ++back) {
    const auto& entry = entries[(next - back) & (run.overrun_log_capacity - 1)];
    if (entry.sequence.load(std::memory_order_acquire) == next - back + 1 && entry.module == module) {
      return &entry;
    }
  }
  return nullptr;
}

std::string describe_overrun(const scheduler::RunBlock& run, const scheduler::OverrunEntry& entry) {
  std::string text =
      fmt::format("the last at tick {} (slot {}): ", std::uint64_t{entry.tick}, std::uint64_t{entry.slot});
  text += entry.started != 0 ? fmt::format("it had been running for {:.1f} us after starting {:.1f} us late",
                                           in_microseconds(entry.own_ns), in_microseconds(entry.latency_ns))
                             : std::string("it was still waiting for its turn");
  if (entry.previous >= 0) {
    text += fmt::format("; before it ran {} for {:.1f} us", run.modules()[entry.previous].name,
                        in_microseconds(entry.previous_ns));
  }
  return text;
}

// What is said of a module in a summary.
struct SummaryLine {
  std::string_view module;
  std::string text;
};

}  // namespace

void Console::watch(scheduler::RunBlock& run) {
  run_ = &run;
  seen_.assign(run.module_capacity, Seen{});
  reader_.emplace(run);
}

void Console::report(rt::MonoTime now, bool last) {
  if (run_ == nullptr) {
    return;
  }
  print_messages(now, last ? base::kPatienceAtEnd : milliseconds(0));
  report_faults();
  if (last || now >= next_summary_) {
    report_overruns(now, last);
    report_losses();
  }
}

// What standard output does not take at once stays where the modules have printed it, and is lost there if it takes
// too long: report_losses() counts it.
void Console::print_messages(rt::MonoTime now, milliseconds patience) {
  constexpr std::size_t kAtOnce = 2048;  // bytes; they stay in stdio's buffer until it is flushed
  while (reader_->has_any() && (has_journal() || base::flush_standard_output(patience))) {
    std::size_t printed = 0;
    for (runtime::Message message; printed < kAtOnce && reader_->next(message, now);) {
      print_message(message);
      printed += message.text.size() + 1;
    }
    if (printed == 0) {
      return;  // the next one is not finished
    }
    (void)base::flush_standard_output(patience);
  }
}

// A line feed at the end ends a line of text; entries of the journal have none.
void Console::print_message(const runtime::Message& message) const {
  if (!has_journal()) {
    std::fwrite(message.text.data(), 1, message.text.size(), stdout);
    return;
  }
  const std::string_view text = message.text.substr(0, message.text.find_last_not_of('\n') + 1);
  const bool of_module = message.module < run_->module_count;
  about(of_module ? run_->modules()[message.module].name : "")
      .enter(base::Journal::Priority::Info, base::printable(text, "\t\n"));
}

void Console::report_faults() {
  for (std::uint32_t i = 0; i < run_->module_count; ++i) {
    const scheduler::ModuleRecord& module = run_->modules()[i];
    const std::uint64_t faults = module.faults.load(std::memory_order_acquire);
    if (faults != seen_[i].faults) {
      seen_[i].faults = faults;
      about(module.name)
          .error("module {} faulted at tick {}: {}", module.name, module.fault_tick.load(std::memory_order_relaxed),
                 module.last_fault);
    }
  }
}

void Console::report_overruns(rt::MonoTime now, bool last) {
  next_summary_ = now + kSummary;
  std::vector<SummaryLine> lines;
  for (std::uint32_t i = 0; i < run_->module_count; ++i) {
    const scheduler::ModuleRecord& module = run_->modules()[i];
    const std::uint64_t overruns = module.overruns.load(std::memory_order_relaxed);
    if (const std::uint64_t fresh = overruns - seen_[i].overruns; fresh > 0) {
      const scheduler::OverrunEntry* entry = newest_overrun(*run_, i);
      lines.push_back({module.name, fmt::format("{} overrun{}{}", fresh, fresh == 1 ? "" : "s",
                                                entry == nullptr ? "" : ", " + describe_overrun(*run_, *entry))});
      seen_[i].overruns = overruns;
    }
    const std::uint64_t misses = module.deadline_misses.load(std::memory_order_relaxed);
    if (const std::uint64_t fresh = misses - seen_[i].misses; fresh > 0) {
      lines.push_back({module.name, fmt::format("{} deadline{} of {:.1f} us missed", fresh, fresh == 1 ? "" : "s",
                                                in_microseconds(module.deadline_ns))});
      seen_[i].misses = misses;
    }
  }
  for (std::size_t i = 0; i < std::min(lines.size(), kMaxLines); ++i) {
    about(lines[i].module).warning("module {}: {}", lines[i].module, lines[i].text);
  }
  if (lines.size() > kMaxLines) {
    warning("... and {} more of this kind in 1 s: `indurop overruns` and `indurop status` show all",
            lines.size() - kMaxLines);
  }
  if (const std::uint64_t lost = run_->lost_ticks.load(std::memory_order_relaxed); last && lost > 0) {
    warning("{} basic periods lost in all: nothing could be started in them", lost);
  }
}

void Console::report_losses() {
  for (std::uint32_t i = 0; i < run_->module_count; ++i) {
    const scheduler::ModuleRecord& module = run_->modules()[i];
    const std::uint64_t lost = module.lost_messages.load(std::memory_order_relaxed);
    if (lost > seen_[i].lost_messages) {
      about(module.name)
          .warning("module {}: {} lines of irp::printf dropped, its ring was full", module.name,
                   lost - seen_[i].lost_messages);
      seen_[i].lost_messages = lost;
    }
  }
}

}  // namespace indurop::node
