// SPDX-License-Identifier: Apache-2.0
#include "node/parts/keyframe_part.h"

#include <string>
#include <utility>

namespace indurop::node {
namespace {

constexpr std::chrono::milliseconds kKeyframePeriod{500};
constexpr std::uint32_t kMissedInARow = 10;  // then it is reported

// A reader sees the entry of a module's code before what this code changes only where stores keep their order.
#if defined(__x86_64__)
constexpr bool kStoresKeepOrder = true;
#else
constexpr bool kStoresKeepOrder = false;
#endif

}  // namespace

std::unique_ptr<KeyframePart> KeyframePart::begin(const Options& options, const Prepared& prepared,
                                                  const Loaded& loaded, const scheduler::Engine& engine,
                                                  const Console& console) {
  std::vector<Subject> subjects;
  std::vector<tape::KeyframePlan> plans;
  for (std::uint32_t i = 0; kStoresKeepOrder && prepared.tape && i < loaded.libraries.size(); ++i) {
    const ModuleMemory& memory = loaded.libraries[i].memory();
    if (memory.is_whole() && prepared.tape->of(i) != nullptr && engine.band_of(i) != nullptr) {
      subjects.push_back({i, &memory, memory.form()});
      plans.push_back({i, memory.most(), memory.form()});
    }
  }
  (void)vars::remove_shm_file(vars::keyframe_file(options.node));  // left by an earlier run
  ProcessRequests processes(options.node, prepared, options.simulation.on);
  std::optional<tape::KeyframeWriter> writer;
  if (!plans.empty()) {
    auto created = tape::KeyframeWriter::create(options.node, plans);
    if (!created) {
      console.warning("no keyframes are taken: {}", describe(created.error()));
      return nullptr;
    }
    writer.emplace(std::move(created).value());
  } else if (processes.empty()) {
    return nullptr;
  }
  return std::unique_ptr<KeyframePart>(
      new KeyframePart(prepared, engine, console, std::move(subjects), std::move(writer), std::move(processes)));
}

KeyframePart::KeyframePart(const Prepared& prepared, const scheduler::Engine& engine, const Console& console,
                           std::vector<Subject> subjects, std::optional<tape::KeyframeWriter> writer,
                           ProcessRequests processes)
    : prepared_(prepared),
      engine_(engine),
      console_(console),
      subjects_(std::move(subjects)),
      writer_(std::move(writer)),
      processes_(std::move(processes)) {}

void KeyframePart::begin_period() {
  for (std::size_t i = 0; i < subjects_.size(); ++i) {
    Subject& subject = subjects_[i];
    const scheduler::ModuleRecord& record = prepared_.run().modules()[subject.module];
    if (subject.due && record.state.load() == scheduler::ModuleState::Running) {
      writer_->note_missed(i);
      if (++subject.missed == kMissedInARow) {
        const std::string astray = subject.memory->astray();
        console_.about(record.name)
            .warning("module {}: no keyframe for {} s, because {}", record.name,
                     (kKeyframePeriod * kMissedInARow).count() / 1000,
                     astray.empty() ? "its runs leave too little time between them, or it cannot be taken now"
                                    : astray + " leads to what is not kept");
      }
    }
    subject.due = true;
  }
  processes_.begin_period();
}

void KeyframePart::take(scheduler::Kernel& kernel, const Exchanges& exchanges) {
  if (const rt::MonoTime now = kernel.now(); now >= next_) {
    if (next_ != rt::MonoTime{}) {
      begin_period();
    }
    next_ = now + kKeyframePeriod;
  }
  for (std::size_t i = 0; i < subjects_.size(); ++i) {
    if (subjects_[i].memory->form() != subjects_[i].form) {
      subjects_[i].due = false;
    }
    if (subjects_[i].due && !exchanges.is_open(subjects_[i].module) && take_one(i, kernel)) {
      subjects_[i].due = false;
      subjects_[i].missed = 0;
    }
  }
  processes_.ask();
}

// The copy counts if no code of the module was being executed before it and none was entered until it was complete.
// Commands stop and start modules on this thread, so start() and stop() are not running either.
bool KeyframePart::take_one(std::size_t index, scheduler::Kernel& kernel) {
  const Subject& subject = subjects_[index];
  const scheduler::RunBlock& run = prepared_.run();
  const scheduler::ModuleRecord& record = run.modules()[subject.module];
  const auto before = engine_.entries_if_outside(subject.module);
  if (!before || record.state.load() != scheduler::ModuleState::Running) {
    return false;
  }
  tape::KeyframeHead head;
  head.run = prepared_.tape->of(subject.module)->runs();
  head.tick = run.tick.load();
  head.time_ns = rt::to_ns(kernel.now());
  head.bytes = subject.memory->save(writer_->room(index));
  std::atomic_thread_fence(std::memory_order_acquire);
  const bool whole = head.bytes > 0 && engine_.entries_if_outside(subject.module) == before;
  if (whole) {
    writer_->publish(index, head);
  }
  return whole;
}

}  // namespace indurop::node
