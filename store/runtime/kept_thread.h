// SPDX-License-Identifier: Apache-2.0
// What this process module keeps, for the node: a normal thread copies it, or puts it back, between two runs when the
// node asks for it. The thread of the runs only counts.

#pragma once

#include <indurop/state.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "core/rt/thread.h"
#include "scheduler/run_block.h"
#include "store/tape/process_keyframes.h"
#include "store/tape/state_form.h"
#include "store/tape/track.h"

namespace indurop::runtime {

class KeptThread {
 public:
  // Returns null if this program does not declare what it keeps (INDUROP_STATE), or something that cannot be copied.
  // Until start(), only a node that exchanges the process sees it. `run` is borrowed. Not real-time safe.
  static std::unique_ptr<KeptThread> prepare(const std::string& node, std::uint32_t module,
                                             const scheduler::RunBlock& run);
  KeptThread(const KeptThread&) = delete;
  KeptThread& operator=(const KeptThread&) = delete;
  ~KeptThread();

  // The process runs from now on. `track`, borrowed: null if the node has no tape. Returns false if nothing can be
  // asked of it, as if it declared nothing.
  bool start(const std::string& node, std::uint32_t module, const tape::Track* track);

  // Instead of start() if the process follows another one: puts back what that one has handed over, by name and type.
  // Before start(). Returns false if it does not fit.
  bool take_over(const tape::ProcessKeyframes& from);
  // The node allows that something is lost.
  [[nodiscard]] bool may_lose() const noexcept { return file_.words().lossy.load() != 0; }
  // Another process follows, and this one executes no run: writes what it keeps, and answers nothing from here on.
  void hand_over();

  // Called by the thread of the runs, before the first and after the last instruction of each. Real-time safe.
  void enter() noexcept {
    entries_.store(entries_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
    std::atomic_thread_fence(std::memory_order_release);  // before anything that the run changes
  }
  void leave() noexcept { entries_.store(entries_.load(std::memory_order_relaxed) + 1, std::memory_order_release); }

 private:
  KeptThread(const StateDescriptor& declared, const scheduler::RunBlock& run, tape::ProcessKeyframes file)
      : declared_(declared), run_(run), file_(std::move(file)) {}
  void answer();
  bool take();
  bool put_back();
  void put_back(const tape::FormLine& line, std::span<const std::uint8_t> bytes);

  StateDescriptor declared_;
  const scheduler::RunBlock& run_;
  std::atomic<const tape::Track*> track_{nullptr};
  tape::ProcessKeyframes file_;
  std::atomic<std::uint64_t> entries_{0};  // odd: a run is being executed
  std::atomic<bool> ending_{false};
  std::atomic<bool> is_copying_{false};  // stays so when the process is handed over
  rt::Thread thread_;
};

}  // namespace indurop::runtime
