// SPDX-License-Identifier: Apache-2.0
// One client of the stream. At most one frame of each subscription waits for it: a newer one replaces it, and the
// replaced one is counted as dropped.

#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "tools/serve/stream/follower.h"
#include "tools/serve/stream/hub.h"
#include "tools/serve/stream/outbox.h"

namespace indurop::serve {

class StreamClient final : public Follower {
 public:
  StreamClient(Hub& hub, Line& line, std::uint64_t id, std::string address);
  StreamClient(const StreamClient&) = delete;
  StreamClient& operator=(const StreamClient&) = delete;
  ~StreamClient() override;

  int receive(std::string_view text) override;
  SharedMessage next() override;

  void send_word(std::string_view word) override;
  void sampled(const Feed& feed) override;
  void ended(const Feed& feed, const Board* board) override;
  void boards_updated() override {}  // the hub's message reports it
  [[nodiscard]] ClientFigures figures() const override;

 private:
  struct Subscription {
    std::shared_ptr<Feed> feed;
    bool binary = false;
    bool waiting = false;        // its sample has to be sent
    std::uint64_t sent_seq = 0;  // 0: none yet
    std::uint64_t untold = 0;    // dropped since the last frame
    std::uint64_t dropped = 0;
  };

  void subscribe(const ClientWord& word);
  SharedMessage frame_of(Subscription& subscription);

  Hub* hub_;
  Outbox outbox_;
  std::map<std::uint32_t, Subscription> subscriptions_;
};

}  // namespace indurop::serve
