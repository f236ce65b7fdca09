// SPDX-License-Identifier: Apache-2.0
// The messages that wait for one client of the stream: answers in their order, then the samples of its subscriptions,
// one subscription after another. Counts what was sent.

#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "core/rt/clock.h"
#include "tools/serve/api/api.h"
#include "tools/serve/door/house.h"

namespace indurop::serve {

class Outbox {
 public:
  // Code with which a client is disconnected that only sends and does not read.
  static constexpr int kTooManyAnswers = 1008;

  Outbox(Line& line, std::uint64_t id, std::string address) : line_(&line) {
    figures_.id = id;
    figures_.address = std::move(address);
    figures_.since_ns = rt::now_ns();
  }

  void add(std::string_view answer) {
    answers_.push_back(std::make_shared<Message>(answer));
    line_->ask();
  }
  [[nodiscard]] bool is_full() const noexcept { return answers_.size() > kMostAnswers; }
  // To be called when a sample waits.
  void wake() { line_->ask(); }
  void count_dropped() noexcept { ++figures_.dropped; }

  // Returns the next message; null: none waits. `subscriptions` is a map by id; `take` returns the message of one
  // entry, null if none of it waits.
  template <class Subscriptions, class Take>
  SharedMessage next(Subscriptions& subscriptions, Take take) {
    SharedMessage message;
    if (!answers_.empty()) {
      message = std::move(answers_.front());
      answers_.pop_front();
    } else {
      auto turn = subscriptions.upper_bound(last_served_);
      for (std::size_t i = 0; i < subscriptions.size() && !message; ++i) {
        turn = turn == subscriptions.end() ? subscriptions.begin() : turn;
        last_served_ = turn->first;
        message = take(*turn);
        ++turn;
      }
    }
    figures_.sent_bytes += message ? message->size() : 0;
    return message;
  }
  void count_sent() noexcept { ++figures_.sent; }

  [[nodiscard]] ClientFigures figures(std::size_t streams) const {
    ClientFigures now = figures_;
    now.streams = streams;
    return now;
  }

 private:
  static constexpr std::size_t kMostAnswers = 256;

  Line* line_;
  std::deque<SharedMessage> answers_;
  std::uint32_t last_served_ = 0;
  ClientFigures figures_;
};

}  // namespace indurop::serve
