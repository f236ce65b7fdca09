// SPDX-License-Identifier: Apache-2.0
// A WebSocket to `indurop serve` (RFC 6455, the client's side).

#pragma once

#include <indurop/result.h>

#include <chrono>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/problem.h"
#include "doors/mqtt/serve/connection.h"
#include "doors/mqtt/serve/http.h"

namespace indurop::mqtt {

struct WebSocketMessage {
  bool binary = false;
  std::string bytes;
};

// Takes frames of a server apart. Pings and the end of the connection are messages of their own.
class FrameParser {
 public:
  enum class Kind { Text, Binary, Ping, Close };
  struct Message {
    Kind kind;
    std::string bytes;
  };
  // Returns the complete messages; false: the bytes are no frames that a server may send.
  bool feed(std::string_view bytes, std::vector<Message>& to);

 private:
  // Handles the first frame in `pending_` if it is complete. Returns its size, 0: it is not; or no value.
  bool take(std::vector<Message>& to, bool& complete);

  std::string pending_;
  std::string message_;  // of fragments so far
  Kind kind_ = Kind::Text;
  bool in_message_ = false;
};

// A frame of a client: with the mask, which is random.
std::string client_frame(unsigned opcode, std::string_view payload);

// Used by one thread.
class WebSocket {
 public:
  // Errors: no answer, or the server's reason for a refusal.
  static Result<WebSocket, base::Problem> open(const ServeAccess& access, std::string_view path,
                                               std::string_view protocol, const std::string& token);

  Result<void, base::Problem> send(std::string_view text);
  // Returns what has arrived, waiting at most so long for it. Errors: the connection has ended.
  Result<std::vector<WebSocketMessage>, base::Problem> receive(std::chrono::milliseconds wait);
  [[nodiscard]] int descriptor() const noexcept { return connection_.descriptor(); }

 private:
  explicit WebSocket(Connection connection) : connection_(std::move(connection)) {}

  Connection connection_;
  FrameParser frames_;
  std::string first_;  // what arrived with the answer to the handshake
};

}  // namespace indurop::mqtt
