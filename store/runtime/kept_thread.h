// SPDX-License-Identifier: Apache-2.0
// What this process module keeps, for the node: a normal thread copies it, or puts it back, between two runs when the
// node asks for it. The thread of the runs only counts.

#pragma once

#include <indurop/state.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>

#include "core/rt/thread.h"
#include "scheduler/run_block.h"
#include "store/tape/process_keyframes.h"
#include "store/tape/track.h"

namespace indurop::runtime {

class KeptThread {
 public:
  // Returns null if this program does not declare what it keeps (INDUROP_STATE), or something that cannot be copied.
  // `track`: null if the node has no tape. All are borrowed. Not real-time safe.
  static std::unique_ptr<KeptThread> begin(const std::string& node, std::uint32_t module,
                                           const scheduler::RunBlock& run, const tape::Track* track);
  KeptThread(const KeptThread&) = delete;
  KeptThread& operator=(const KeptThread&) = delete;
  ~KeptThread();

  // Called by the thread of the runs, before the first and after the last instruction of each. Real-time safe.
  void enter() noexcept {
    entries_.store(entries_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
    std::atomic_thread_fence(std::memory_order_release);  // before anything that the run changes
  }
  void leave() noexcept { entries_.store(entries_.load(std::memory_order_relaxed) + 1, std::memory_order_release); }

 private:
  KeptThread(const StateDescriptor& declared, const scheduler::RunBlock& run, const tape::Track* track,
             tape::ProcessKeyframes file)
      : declared_(declared), run_(run), track_(track), file_(std::move(file)) {}
  void answer();
  bool take();
  bool put_back();

  StateDescriptor declared_;
  const scheduler::RunBlock& run_;
  const tape::Track* track_;
  tape::ProcessKeyframes file_;
  std::atomic<std::uint64_t> entries_{0};  // odd: a run is being executed
  std::atomic<bool> ending_{false};
  rt::Thread thread_;
};

}  // namespace indurop::runtime
