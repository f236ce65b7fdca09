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
#include "core/base/web_socket_frames.h"
#include "doors/mqtt/serve/connection.h"
#include "doors/mqtt/serve/http.h"

namespace indurop::mqtt {

struct WebSocketMessage {
  bool binary = false;
  std::string bytes;
};

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
  // Sends a frame with a mask of its own.
  Result<void, base::Problem> send(base::FrameKind kind, std::string_view payload);

  static constexpr std::size_t kMostMessageBytes = std::size_t{64} << 20U;

  explicit WebSocket(Connection connection) : connection_(std::move(connection)) {}

  Connection connection_;
  base::FrameReader frames_{base::FrameSender::Server, kMostMessageBytes};
  std::string first_;  // what arrived with the answer to the handshake
};

}  // namespace indurop::mqtt
