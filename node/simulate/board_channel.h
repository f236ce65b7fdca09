// SPDX-License-Identifier: Apache-2.0
// Messages between the conductor of a simulated plant and its boards, each a program of its own: how far to advance,
// and what was sent on the network meanwhile. Both ends of the socket.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "network/mirror/simulated/message.h"

namespace indurop::node {

// First message to a board.
struct BoardPlace {
  std::int64_t begin_ns = 0;        // virtual time
  std::uint32_t own = 0;            // index of the board in `boards`
  std::vector<std::string> boards;  // of the plant
};

struct BoardOrder {
  bool end = false;  // end of the run, because of `signal`; 0: ended without a signal
  int signal = 0;
  std::int64_t until_ns = 0;              // advance to this time, and not further
  std::vector<mirror::Message> arrivals;  // messages on the network, in order
};

// Sent after each order, and once when the board is ready.
struct BoardAnswer {
  std::int64_t now_ns = 0;
  std::int64_t next_ns = 0;   // time of its next event without input from outside
  std::int64_t epoch_ns = 0;  // of its tick 0
  std::int64_t basic_period_ns = 0;
  std::int64_t took_ns = 0;  // processor time since the last answer
  bool ended = false;        // its duration is over, or a module has ended it
  std::vector<mirror::Message> sent;
};

class BoardChannel {
 public:
  // Owns the socket; it is not inherited by other programs.
  explicit BoardChannel(int socket) noexcept;
  BoardChannel(BoardChannel&& other) noexcept;
  BoardChannel& operator=(BoardChannel&& other) noexcept;
  BoardChannel(const BoardChannel&) = delete;
  BoardChannel& operator=(const BoardChannel&) = delete;
  ~BoardChannel();

  // Returns false if the other end is closed.
  bool send(const BoardPlace& place);
  bool send(const BoardOrder& order);
  bool send(const BoardAnswer& answer);

  enum class Got { Word, Nothing, End };
  // Waits a moment for a message; End: the other end is closed.
  Got receive(BoardPlace& place);
  Got receive(BoardOrder& order);
  Got receive(BoardAnswer& answer);

 private:
  bool send(const std::vector<std::uint8_t>& body);
  Got receive();

  int socket_;
  std::vector<std::uint8_t> received_;  // may end with an incomplete message
  std::vector<std::uint8_t> word_;
  std::vector<std::uint8_t> buffer_;
};

}  // namespace indurop::node
