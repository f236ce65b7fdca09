// SPDX-License-Identifier: Apache-2.0
// Keyframes of a process module, in shared memory of its own: the process writes them when the node asks for one. In a
// replay, the node writes what the process is to put back. Not real-time safe.

#pragma once

#include <indurop/result.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>

#include "core/rt/signal_word.h"
#include "store/tape/keyframes.h"

namespace indurop::tape {

// Whether a process that another one follows has written what it kept after its last run.
enum class HandOver : std::uint32_t { None, Written, Failed };

// What the node asks the process for, at the end of the memory. One request at a time.
struct KeyframeRequestWords {
  rt::SignalWord wake;                   // wakes the process
  std::atomic<std::uint64_t> asked;      // number of the last request
  std::atomic<std::uint64_t> answered;   // number of the last request that was answered
  std::atomic<std::uint64_t> bytes;      // in the room, to put back
  std::atomic<std::uint32_t> puts_back;  // 1: what is in the room is put back; 0: a keyframe is written
  std::atomic<std::uint32_t> done;       // 0: it was not possible, because a run was being executed
  std::atomic<HandOver> hand_over;       // Written: the newest keyframe has what it kept
  std::atomic<std::uint32_t> lossy;      // 1: the process may follow although it cannot take over everything
};

class ProcessKeyframes {
 public:
  struct Plan {
    std::string form;
    std::uint64_t most = 0;  // bytes of one keyframe
  };
  // Those of the process that runs, and of one that prepares itself to follow it.
  enum class Of { Running, Next };
  // The process's end, as one that prepares itself. Errors: those of KeyframeWriter.
  static Result<ProcessKeyframes> create(const std::string& node, std::uint32_t module, std::int32_t node_pid,
                                         const Plan& plan);
  // Replaces those of the process that ran before. Errors: System.
  static Status set_running(const std::string& node, std::uint32_t module);
  static void remove(const std::string& node, std::uint32_t module, Of of);
  // The node's end, or that of a process that follows. Errors: NotFound (the process declares nothing), those of
  // KeyframeFollower.
  static Result<ProcessKeyframes> open(const std::string& node, std::uint32_t module, std::int32_t node_pid,
                                       Of of = Of::Running);

  // For one thread of each end.
  [[nodiscard]] KeyframeRequestWords& words() const noexcept;
  [[nodiscard]] std::span<std::byte> room() noexcept { return writer_.room(0); }
  void publish(const KeyframeHead& head) noexcept { writer_.publish(0, head); }
  [[nodiscard]] std::string form() const { return writer_.form(0); }
  // The bytes of the newest keyframe; empty: there is none.
  [[nodiscard]] std::span<const std::uint8_t> newest() const noexcept { return writer_.newest(0); }

 private:
  explicit ProcessKeyframes(KeyframeWriter&& writer) : writer_(std::move(writer)) {}
  KeyframeWriter writer_;
};

// The file of the keyframes of the process that runs.
std::string process_keyframe_file(const std::string& node, std::uint32_t module);

}  // namespace indurop::tape
