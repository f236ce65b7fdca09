// SPDX-License-Identifier: Apache-2.0
// The interface that answers the requests of a Door and talks to the clients of WebSockets. All calls come from the
// door's one thread; none may block.

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/serve/door/request.h"

namespace indurop::serve {

// A message to a WebSocket. Many clients share one: the frame's header is the same for all, and is written into the
// space in front of the payload.
struct Message {
  static constexpr std::size_t kRoom = 32;
  explicit Message(std::string_view text, bool is_binary = false) : bytes(kRoom), binary(is_binary) {
    bytes.insert(bytes.end(), text.begin(), text.end());
  }
  [[nodiscard]] std::size_t size() const noexcept { return bytes.size() - kRoom; }

  std::vector<unsigned char> bytes;
  bool binary = false;
};
using SharedMessage = std::shared_ptr<Message>;

// The subprotocol of InduRoP.
inline constexpr const char* kStream = "indurop.v1";
// Subprotocols of https://github.com/foxglove/ws-protocol, under two names: that of third-party servers and that of
// Foxglove's own.
inline constexpr const char* kFoxglove = "foxglove.websocket.v1";
inline constexpr const char* kFoxgloveSdk = "foxglove.sdk.v1";
constexpr bool is_foxglove(std::string_view subprotocol) noexcept {
  return subprotocol == kFoxglove || subprotocol == kFoxgloveSdk;
}

// The connection to a client with a WebSocket.
class Line {
 public:
  Line() = default;
  Line(const Line&) = delete;
  Line& operator=(const Line&) = delete;
  virtual ~Line() = default;
  virtual void ask() = 0;  // next() is called once the client can receive
};

// A client with a WebSocket as the house sees it. Deleted when the connection has ended.
class Visitor {
 public:
  Visitor() = default;
  Visitor(const Visitor&) = delete;
  Visitor& operator=(const Visitor&) = delete;
  virtual ~Visitor() = default;
  // Receives a text message. A result other than 0 is the code to close with.
  virtual int receive(std::string_view text) = 0;
  // Returns the message to send now, null: none. It is called again until it returns null.
  virtual SharedMessage next() = 0;
};

// Identifies a request whose reply may come later.
using Ticket = std::uint64_t;

class House {
 public:
  House() = default;
  House(const House&) = delete;
  House& operator=(const House&) = delete;
  virtual ~House() = default;
  // Returns which of the subprotocols that a client requests is used; empty: none of them.
  virtual std::string choose_subprotocol(const Request& request) = 0;
  // Returns the client that presented this certificate (PEM), which is signed by the authority.
  virtual Client identify(const std::string& certificate) = 0;
  // Returns the refusal of this request, from its headers alone; else fills in its `client`.
  virtual std::optional<Reply> refuse(Request& request) = 0;
  // Logs that `count` requests of this address were refused for their token or certificate, or because their client has
  // no right; `request` is the last one.
  virtual void note_refused(const Request& request, const std::string& why, std::uint64_t count) = 0;
  // Returns the reply; nothing: it comes later, by Door::reply().
  virtual std::optional<Reply> answer(const Request& request, Ticket ticket) = 0;
  virtual std::unique_ptr<Visitor> receive(const Request& request, Line& line) = 0;
};

}  // namespace indurop::serve
