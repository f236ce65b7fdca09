// SPDX-License-Identifier: Apache-2.0
// The stream of `indurop serve`: the boards that it shows and the frames of their variables. It is opened again
// whenever it is lost.

#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/base/json.h"
#include "doors/mqtt/model/board.h"
#include "doors/mqtt/serve/web_socket.h"

namespace indurop::mqtt {

struct StreamSettings {
  ServeAccess access;
  std::string token;               // empty: none
  std::vector<std::string> names;  // variables or globs of each board
  double rate_hz = 10;
};

struct StreamEvents {
  std::function<void()> opened;
  std::function<void(const std::string& why)> lost;                 // all boards are gone with it; once for each reason
  std::function<void(const std::string& board, bool alive)> state;  // new, or other than before
  std::function<void(const std::string& board)> gone;               // or has other variables
  std::function<void(const base::Json& subscribed)> described;      // its variables; frames follow
  std::function<void(const Frame& frame)> frame;
  std::function<void(const std::string& text)> trouble;
};

// Used by one thread.
class Stream {
 public:
  Stream(StreamSettings settings, StreamEvents events) : settings_(std::move(settings)), events_(std::move(events)) {}

  // Receives what has arrived, and connects if that is due. Waits at most some seconds, for a server that is just being
  // reached.
  void run(std::int64_t now_ns);
  // To wait for; negative: there is no connection.
  [[nodiscard]] int descriptor() const noexcept { return socket_ ? socket_->descriptor() : -1; }

 private:
  void connect(std::int64_t now_ns);
  void lose(const std::string& why, std::int64_t now_ns);
  void receive(const WebSocketMessage& message);
  void receive_boards(const base::Json& message);
  void subscribe();
  void end(std::uint64_t id);

  StreamSettings settings_;
  StreamEvents events_;
  std::optional<WebSocket> socket_;
  std::int64_t next_try_ns_ = 0;
  std::int64_t heard_ns_ = 0;
  std::string last_why_;
  std::string last_trouble_;
  std::map<std::string, bool> boards_;              // alive or not
  std::map<std::uint64_t, std::string> requested_;  // boards by the id of their subscription
  std::set<std::string> without_;                   // boards that have no variables at present
  std::uint64_t last_id_ = 0;
  std::int64_t retry_ns_ = 0;  // when boards that could not be subscribed to are tried again
};

}  // namespace indurop::mqtt
