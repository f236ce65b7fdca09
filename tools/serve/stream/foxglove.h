// SPDX-License-Identifier: Apache-2.0
// A client that uses Foxglove's protocol: each variable is a channel. At most one message per subscription waits; a
// newer one replaces it, and the replaced ones are counted and reported.

#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tools/serve/stream/follower.h"
#include "tools/serve/stream/hub.h"
#include "tools/serve/stream/outbox.h"

namespace indurop::serve {

class FoxgloveClient final : public Follower {
 public:
  // `hub`, `line` and `settings` are borrowed.
  FoxgloveClient(Hub& hub, Line& line, std::uint64_t id, std::string address, const FoxgloveSettings& settings);
  FoxgloveClient(const FoxgloveClient&) = delete;
  FoxgloveClient& operator=(const FoxgloveClient&) = delete;
  ~FoxgloveClient() override;

  int receive(std::string_view text) override;
  SharedMessage next() override;

  void send_word(std::string_view /*word*/) override {}  // part of another protocol
  void sampled(const Feed& feed) override;
  void ended(const Feed& feed, const Board* board) override;
  // Advertises the variables of boards that came or changed, withdraws those of boards that went.
  void boards_updated() override;
  [[nodiscard]] ClientFigures figures() const override;

 private:
  struct Channel {
    std::string board;
    std::string name;
  };
  struct Offered {
    std::string layout;
    std::vector<std::uint32_t> channels;
  };
  struct Subscription {
    std::uint32_t channel = 0;
    std::shared_ptr<Feed> feed;
    bool waiting = false;  // its sample has to be sent
  };

  void send(const std::string& text);
  void offer(const Board& board);
  void withdraw(const Offered& offered);
  void subscribe(std::uint32_t id, std::uint32_t channel);
  void unsubscribe(std::uint32_t id);
  SharedMessage message_of(std::uint32_t id, Subscription& subscription);

  Hub* hub_;
  const FoxgloveSettings* settings_;
  Outbox outbox_;
  std::uint32_t last_channel_ = 0;
  std::map<std::uint32_t, Channel> channels_;
  std::map<std::string, Offered, std::less<>> offered_;  // by board
  std::map<std::uint32_t, Subscription> subscriptions_;
  std::map<const Feed*, std::uint32_t> of_feed_;  // ids of their subscriptions
  std::vector<std::uint8_t> cdr_;
  std::uint64_t dropped_ = 0;   // dropped messages that were not reported yet
  std::int64_t warned_ns_ = 0;  // time of the last warning about them
};

}  // namespace indurop::serve
