// SPDX-License-Identifier: Apache-2.0
// The answers to commands that have arrived and were not taken yet. DDS keeps the last samples of all writers together,
// so a participant that answers all the time would displace the answers of others. Here each writer has a place of its
// own, for the last few of its answers.

#pragma once

#include <cstddef>
#include <deque>
#include <map>
#include <mutex>
#include <vector>

#include "core/rt/signal_word.h"
#include "deploy/words/command_words.h"
#include "network/dds/endpoint.h"

namespace indurop::deploy {

class ReplyInbox {
 public:
  static constexpr std::size_t kMaxOfWriter = 16;  // answers kept of one writer: older ones are discarded

  // Signals `wake` when something has arrived; borrows it.
  explicit ReplyInbox(rt::SignalWord& wake) : wake_(wake) {}

  // For the reader of answers, which must be deleted first.
  [[nodiscard]] dds::Listener listener();

  struct Received {
    dds::InstanceHandle publication = 0;
    CommandReply reply;
  };
  // Returns what has arrived since the last call, the answers of each writer in their order.
  [[nodiscard]] std::vector<Received> take();

 private:
  void receive(dds::Handle reader);  // called by threads of DDS

  rt::SignalWord& wake_;
  std::mutex mutex_;  // of what follows
  std::map<dds::InstanceHandle, std::deque<CommandReply>> received_;
};

}  // namespace indurop::deploy
