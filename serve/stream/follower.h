// SPDX-License-Identifier: Apache-2.0
// A client of the stream, as the hub knows it: whatever protocol it speaks.

#pragma once

#include <string_view>

#include "serve/api/api.h"
#include "serve/door/house.h"
#include "serve/stream/feed.h"

namespace indurop::serve {

class Follower : public Visitor {
 public:
  // The feed has a new sample.
  virtual void sampled(const Feed& feed) = 0;
  // Names or types of its board are others now: the feed is at its end. `board`: null if it has gone.
  virtual void ended(const Feed& feed, const Board* board) = 0;
  // For everybody: boards that came or went, alarms.
  virtual void tell(std::string_view word) = 0;
  // Boards may have come, gone or become others.
  virtual void looked_around() = 0;
  [[nodiscard]] virtual ClientFigures figures() const = 0;
};

}  // namespace indurop::serve
