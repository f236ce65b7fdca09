// SPDX-License-Identifier: Apache-2.0
// A client of the stream as the hub sees it, independent of its protocol.

#pragma once

#include <string_view>

#include "tools/serve/api/api.h"
#include "tools/serve/door/house.h"
#include "tools/serve/stream/feed.h"

namespace indurop::serve {

class Follower : public Visitor {
 public:
  // Called when the feed has a new sample.
  virtual void sampled(const Feed& feed) = 0;
  // Called when names or types of the feed's board have changed: the feed has ended. `board`: null if it has gone.
  virtual void ended(const Feed& feed, const Board* board) = 0;
  // Sends a message for all clients: boards that came or went, alarms.
  virtual void send_word(std::string_view word) = 0;
  // Called after a check for boards that came, went or changed.
  virtual void boards_updated() = 0;
  [[nodiscard]] virtual ClientFigures figures() const = 0;
};

}  // namespace indurop::serve
