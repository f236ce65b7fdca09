// SPDX-License-Identifier: Apache-2.0
// The network between the boards of a simulated plant: the delay of each message, which messages are lost, and the
// outcome for boards that are disconnected, killed and restarted. The same input gives the same output: random numbers
// come from a seed, separately for each pair of boards. No clock, no threads, no files.

#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "network/mirror/simulated/message.h"

namespace indurop::mirror {

struct NetworkModel {
  std::chrono::nanoseconds delay{std::chrono::microseconds(100)};  // minimum; positive
  std::chrono::nanoseconds jitter{};                               // maximum additional delay
  double loss = 0;                                                 // share of messages, 0 to 1
  std::chrono::nanoseconds repeat{std::chrono::milliseconds(5)};   // until a lost one is repeated, unless best effort
  std::uint64_t seed = 1;
  std::chrono::nanoseconds lease{std::chrono::milliseconds(500)};  // a board silent for this time is gone
};

class SimulatedNetwork {
 public:
  SimulatedNetwork(const NetworkModel& model, std::size_t boards);

  // A board sends a message, at the message's time. `earliest`: it does not arrive anywhere before.
  void send(Message message, std::int64_t earliest_ns = 0);
  // Returns what arrives at a board up to and including this time, in order.
  std::vector<Message> take(std::size_t board, std::int64_t until_ns);
  // Returns the time of the next message that a board may answer at once; INT64_MAX: none.
  [[nodiscard]] std::int64_t next_question(std::size_t board) const noexcept;
  [[nodiscard]] std::int64_t next_arrival(std::size_t board) const noexcept;

  // The board's cable is disconnected, and connected again.
  void cut(std::size_t board, std::int64_t now_ns);
  void join(std::size_t board, std::int64_t now_ns);
  // The board falls silent, or leaves in an orderly way, and starts again.
  void kill(std::size_t board, std::int64_t now_ns);
  void leave(std::size_t board, std::int64_t now_ns);
  void start(std::size_t board, std::int64_t now_ns);

 private:
  struct Pending {
    Message message;  // its time is the time of arrival
    std::uint64_t number = 0;
    bool repeated = false;  // it was lost once
  };
  struct Link {
    std::uint64_t chance = 0;
    std::vector<Message::Kind> wanted;  // requested streams
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
  void report_gone(std::size_t board, std::int64_t when_ns);
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
