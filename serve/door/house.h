// SPDX-License-Identifier: Apache-2.0
// What stands behind the door: it answers requests and talks with those who stay. All calls come from the door's one
// thread; none may block.

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "serve/door/request.h"

namespace indurop::serve {

// What goes to a WebSocket. Many clients share one: the frame's header is the same for all, and is written into the
// room in front.
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

// WebSocket close codes we use.
namespace close_code {
inline constexpr int kProtocol = 1002;
inline constexpr int kNotUnderstood = 1003;
inline constexpr int kBadText = 1007;
inline constexpr int kNotAllowed = 1008;
inline constexpr int kTooLarge = 1009;
}  // namespace close_code

// Our own subprotocol.
inline constexpr const char* kStream = "indurop.v1";
// Subprotocols of https://github.com/foxglove/ws-protocol, under two names: of others' servers and of their own.
inline constexpr const char* kFoxglove = "foxglove.websocket.v1";
inline constexpr const char* kFoxgloveSdk = "foxglove.sdk.v1";
constexpr bool is_foxglove(std::string_view subprotocol) noexcept {
  return subprotocol == kFoxglove || subprotocol == kFoxgloveSdk;
}

// The way to a client with a WebSocket.
class Line {
 public:
  Line() = default;
  Line(const Line&) = delete;
  Line& operator=(const Line&) = delete;
  virtual ~Line() = default;
  virtual void ask() = 0;  // next() is called once the client can take something
};

// A client with a WebSocket, as the house knows it. Deleted when the connection has ended.
class Visitor {
 public:
  Visitor() = default;
  Visitor(const Visitor&) = delete;
  Visitor& operator=(const Visitor&) = delete;
  virtual ~Visitor() = default;
  // A text message. Another result than 0 is the code to close with.
  virtual int heard(std::string_view text) = 0;
  // What is sent now, null: nothing. It is asked again as long as there is something.
  virtual SharedMessage next() = 0;
};

// Names a request whose reply may come later.
using Ticket = std::uint64_t;

class House {
 public:
  House() = default;
  House(const House&) = delete;
  House& operator=(const House&) = delete;
  virtual ~House() = default;
  // Which of the subprotocols that a client asks for is spoken with it; empty: none of them.
  virtual std::string choose_subprotocol(const Request& request) = 0;
  // What a client may do that showed this certificate (PEM), which the authority signed.
  virtual Client identify(const std::string& certificate) = 0;
  // Why this request is not answered, from its headers alone. Else `client` of it is filled in.
  virtual std::optional<Reply> refuse(Request& request) = 0;
  // So many requests of this address were refused for what they showed; `request` is the last one.
  virtual void note_refused(const Request& request, const std::string& why, std::uint64_t count) = 0;
  // Nothing: it comes later, by Door::reply().
  virtual std::optional<Reply> answer(const Request& request, Ticket ticket) = 0;
  virtual std::unique_ptr<Visitor> receive(const Request& request, Line& line) = 0;
};

}  // namespace indurop::serve
