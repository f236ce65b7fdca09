// SPDX-License-Identifier: Apache-2.0
// What the conductor of a simulated plant and its boards, each a program of its own, say to each other: how far to go,
// and what was sent on the way. Both ends of the socket.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mirror/simulated/message.h"

namespace indurop::node {

// First word to a board.
struct BoardPlace {
  std::int64_t begin_ns = 0;        // virtual time
  std::uint32_t own = 0;            // its place in `boards`
  std::vector<std::string> boards;  // of the plant
};

struct BoardOrder {
  bool end = false;  // of the run, because of `signal`; 0: nobody wants to go on
  int signal = 0;
  std::int64_t until_ns = 0;              // this far, and not further
  std::vector<mirror::Message> arrivals;  // on the way, in order
};

// After each order, and once when the board is ready.
struct BoardAnswer {
  std::int64_t now_ns = 0;
  std::int64_t next_ns = 0;   // when it does something next by itself
  std::int64_t epoch_ns = 0;  // of its tick 0
  std::int64_t basic_period_ns = 0;
  std::int64_t took_ns = 0;  // processor time since the last answer
  bool ended = false;        // its duration is over, or a module has ended it
  std::vector<mirror::Message> sent;
};

class BoardChannel {
 public:
  // Owns the socket, which it does not pass on to other programs.
  explicit BoardChannel(int socket) noexcept;
  BoardChannel(BoardChannel&& other) noexcept;
  BoardChannel& operator=(BoardChannel&& other) noexcept;
  BoardChannel(const BoardChannel&) = delete;
  BoardChannel& operator=(const BoardChannel&) = delete;
  ~BoardChannel();

  // False: the other end is gone.
  bool send(const BoardPlace& place);
  bool send(const BoardOrder& order);
  bool send(const BoardAnswer& answer);

  enum class Got { Word, Nothing, End };
  // Waits a moment for a word; End: the other end is gone.
  Got receive(BoardPlace& place);
  Got receive(BoardOrder& order);
  Got receive(BoardAnswer& answer);

 private:
  bool send(const std::vector<std::uint8_t>& body);
  Got receive();

  int socket_;
  std::vector<std::uint8_t> received_;  // not all of it is a whole word
  std::vector<std::uint8_t> word_;
  std::vector<std::uint8_t> buffer_;
};

}  // namespace indurop::node
