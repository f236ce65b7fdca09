// SPDX-License-Identifier: Apache-2.0
// The network between the boards of a simulated plant: what each message takes, which are lost, and what becomes of
// boards that are cut off, killed and returned. The same messages in, the same out: chance comes from a seed, for each
// pair of boards on its own. No clock, no threads, no files.

#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "mirror/simulated/message.h"

namespace indurop::mirror {

struct NetworkModel {
  std::chrono::nanoseconds delay{std::chrono::microseconds(100)};  // at least; positive
  std::chrono::nanoseconds jitter{};                               // and up to so much more
  double loss = 0;                                                 // share of messages, 0 to 1
  std::chrono::nanoseconds repeat{std::chrono::milliseconds(5)};   // until a lost one comes, unless it is best effort
  std::uint64_t seed = 1;
  std::chrono::nanoseconds lease{std::chrono::milliseconds(500)};  // a board not heard for so long is gone
};

class SimulatedNetwork {
 public:
  SimulatedNetwork(const NetworkModel& model, std::size_t boards);

  // A board sends something, at the message's time. `earliest`: it arrives nowhere before.
  void send(Message message, std::int64_t earliest_ns = 0);
  // What arrives at a board until this time, this included, in order.
  std::vector<Message> take(std::size_t board, std::int64_t until_ns);
  // The next that a board may answer at once; INT64_MAX: nothing does.
  [[nodiscard]] std::int64_t next_question(std::size_t board) const noexcept;
  [[nodiscard]] std::int64_t next_arrival(std::size_t board) const noexcept;

  // The board's cable is pulled, and put back.
  void cut(std::size_t board, std::int64_t now_ns);
  void join(std::size_t board, std::int64_t now_ns);
  // The board falls silent, or leaves in order, and begins anew.
  void kill(std::size_t board, std::int64_t now_ns);
  void leave(std::size_t board, std::int64_t now_ns);
  void start(std::size_t board, std::int64_t now_ns);

 private:
  struct Pending {
    Message message;  // its time is that of its arrival
    std::uint64_t number = 0;
    bool repeated = false;  // it was lost once
  };
  struct Link {
    std::uint64_t chance = 0;
    std::vector<Message::Kind> wanted;  // streams
  };
  struct Board {
    bool runs = true;
    bool connected = true;
    std::optional<Message> catalogue;
    std::map<std::pair<Message::Kind, std::uint32_t>, Message> last;  // by stream and part
    std::vector<Pending> inbox;                                       // by time, sender and number
  };

  [[nodiscard]] bool linked(std::size_t from, std::size_t to) const noexcept;
  void carry(const Message& message, std::size_t to, std::int64_t earliest_ns, bool may_be_lost);
  void put(std::size_t to, Pending pending);
  void want(std::size_t from, std::size_t to, Message::Kind stream, std::int64_t now_ns);
  void tell_gone(std::size_t board, std::int64_t when_ns);
  void forget_gone(std::size_t board);
  void introduce(std::size_t from, std::size_t to, std::int64_t now_ns);
  void drop_between(std::size_t board);
  double draw(Link& link) const noexcept;

  NetworkModel model_;
  std::vector<Board> boards_;
  std::vector<std::vector<Link>> links_;  // [from][to]
  std::uint64_t number_ = 0;
};

}  // namespace indurop::mirror
