// SPDX-License-Identifier: Apache-2.0
#include "doors/mqtt/serve/web_socket.h"

#include <fmt/format.h>

#include <utility>

#include "core/keys/web_socket_key.h"

namespace indurop::mqtt {

Result<WebSocket, base::Problem> WebSocket::open(const ServeAccess& access, std::string_view path,
                                                 std::string_view protocol, const std::string& token) {
  auto connection = Connection::open(access.address, access.ca);
  if (!connection) {
    return std::move(connection).error();
  }
  const std::string key = keys::web_socket_key();
  const std::string more = fmt::format(
      "upgrade: websocket\r\nconnection: Upgrade\r\nsec-websocket-version: 13\r\nsec-websocket-key: {}\r\n"
      "sec-websocket-protocol: {}\r\n",
      key, protocol);
  if (auto sent = connection->send(request_head(access, "GET", path, token, more)); !sent) {
    return std::move(sent).error();
  }
  std::string got;
  constexpr int kTries = 10;
  for (int i = 0; i < kTries && got.find("\r\n\r\n") == std::string::npos; ++i) {
    if (auto received = connection->receive(got, std::chrono::milliseconds(500)); !received) {
      return std::move(received).error();
    }
  }
  const auto end = got.find("\r\n\r\n");
  if (end == std::string::npos || got.find(keys::web_socket_accept(key)) > end || !got.starts_with("HTTP/1.1 101")) {
    const auto json = base::Json::parse(end != std::string::npos ? std::string_view(got).substr(end + 4) : "");
    const std::string why = json ? (*json)["message"].text().value_or("") : std::string();
    return base::Problem{
        fmt::format("{} does not offer its stream{}{}", access.address.host_and_port(), why.empty() ? "" : ": ", why)};
  }
  WebSocket socket(std::move(*connection));
  socket.first_ = got.substr(end + 4);
  return socket;
}

Result<void, base::Problem> WebSocket::send(base::FrameKind kind, std::string_view payload) {
  return connection_.send(base::masked_frame(kind, payload, keys::web_socket_mask()));
}

Result<void, base::Problem> WebSocket::send(std::string_view text) {
  return send(base::FrameKind::Text, text);
}

Result<std::vector<WebSocketMessage>, base::Problem> WebSocket::receive(std::chrono::milliseconds wait) {
  std::string got = std::exchange(first_, {});
  if (got.empty()) {
    if (auto received = connection_.receive(got, wait); !received) {
      return std::move(received).error();
    }
  }
  std::vector<WebSocketMessage> messages;
  Result<void, base::Problem> answered;
  constexpr int kNormal = 1000;
  const int code = frames_.feed(got, [&](base::FrameKind kind, const std::string& data) {
    if (kind == base::FrameKind::Close) {
      return kNormal;
    }
    if (kind == base::FrameKind::Ping) {
      answered = send(base::FrameKind::Pong, data);
    } else if (kind != base::FrameKind::Pong) {
      messages.push_back({kind == base::FrameKind::Binary, data});
    }
    return 0;
  });
  if (!answered) {
    return std::move(answered).error();
  }
  if (code != 0) {
    return base::Problem{code == kNormal ? "the server closed the stream" : "the server sent no frames of a WebSocket"};
  }
  return messages;
}

}  // namespace indurop::mqtt
