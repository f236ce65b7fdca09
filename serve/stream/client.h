// SPDX-License-Identifier: Apache-2.0
// One client of the stream. Of each of its subscriptions at most one frame waits for it: what comes in the meantime
// replaces that one and is counted as dropped.

#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <string>

#include "serve/stream/hub.h"

namespace indurop::serve {

class StreamClient final : public Visitor {
 public:
  StreamClient(Hub& hub, Line& line, std::uint64_t id, std::string address);
  StreamClient(const StreamClient&) = delete;
  StreamClient& operator=(const StreamClient&) = delete;
  ~StreamClient() override;

  int heard(std::string_view text) override;
  SharedMessage next() override;

  void tell(std::string_view text);
  // The feed has a new sample.
  void sampled(const Feed& feed);
  // The feed is at its end. Returns the subscriptions that ended with it.
  std::vector<std::uint32_t> ended(const Feed& feed);
  [[nodiscard]] ClientFigures figures() const;

 private:
  struct Subscription {
    std::shared_ptr<Feed> feed;
    bool binary = false;
    bool waiting = false;        // its sample is to be sent
    std::uint64_t sent_seq = 0;  // 0: none yet
    std::uint64_t untold = 0;    // dropped since the last frame
    std::uint64_t dropped = 0;
  };

  void subscribe(const ClientWord& word);
  SharedMessage frame_of(Subscription& subscription);

  Hub* hub_;
  Line* line_;
  std::uint64_t id_;
  std::string address_;
  std::int64_t since_ns_;
  std::deque<SharedMessage> control_;
  std::map<std::uint32_t, Subscription> subscriptions_;
  std::uint32_t last_served_ = 0;  // subscriptions take turns
  std::uint64_t sent_ = 0;
  std::uint64_t dropped_ = 0;
  std::uint64_t sent_bytes_ = 0;
};

}  // namespace indurop::serve
