// SPDX-License-Identifier: Apache-2.0
// Transfers text from real-time code to a normal thread: one ring per module in the run block, any number of producers,
// one consumer. An entry's sequence is 2 * lap when free and 2 * lap + 1 when filled, so a zeroed ring is an empty one.
// A producer that dies between taking a ticket and filling its entry only delays the reader.

#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "core/rt/clock.h"
#include "scheduler/run_block.h"

namespace indurop::runtime {

// Writes a message of module `module` (kNoModule: of the node) to its ring. Returns false if it is full: counted in the
// ring and in the module's lost_messages. Longer text is cut at the entry's size. Real-time safe, any thread, any
// process.
bool push_message(scheduler::RunBlock& run, std::uint32_t module, std::string_view text, rt::MonoTime time) noexcept;

struct Message {
  std::uint32_t module = 0;  // index, or kNoModule
  rt::MonoTime time;
  std::string_view text;  // as printed, usually with a newline; valid until the next call
};

// Reads the messages of all rings of a run block. One reader per run block. Not real-time safe.
class MessageReader {
 public:
  explicit MessageReader(scheduler::RunBlock& run);

  // Returns false if there is none. A message that its producer has not finished counts.
  [[nodiscard]] bool has_any() const noexcept;
  // Returns the next message, ring after ring, in order within each ring. Returns false if there is none now.
  bool next(Message& message, rt::MonoTime now);
  // Number of messages that were dropped because a ring was full, or never finished by a producer that died.
  [[nodiscard]] std::uint64_t lost() const noexcept;

 private:
  struct Stuck {
    std::uint64_t ticket = 0;
    rt::MonoTime since;
  };
  bool next_of(std::uint32_t index, Message& message, rt::MonoTime now);

  scheduler::RunBlock& run_;
  std::vector<Stuck> stuck_;
  std::uint32_t at_ = 0;
  scheduler::MessageEntry copy_{};
};

// The time a reader waits for an entry that a producer has begun to fill.
inline constexpr std::chrono::seconds kUnfinishedMessage{1};

}  // namespace indurop::runtime
