// SPDX-License-Identifier: Apache-2.0
// The part of a connection that handles the WebSocket and the change to it.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/keys/web_socket_key.h"
#include "tools/serve/door/connection.h"

namespace indurop::serve {
namespace {

// A client that is silent for the first time gets a ping, for the second time it is closed.
constexpr std::int64_t kPingNs = 15 * kSecondNs;
constexpr std::int64_t kSilentNs = 30 * kSecondNs;
constexpr std::size_t kMostOutput = 64U << 10;  // waiting control frames
// One of this many streams is reserved for clients with a token or certificate.
constexpr std::size_t kReserve = 8;

}  // namespace

bool Connection::upgrade(const Head& head, Request request, std::int64_t now_ns) {
  const auto bad = [&](const char* why) { return refuse(refusal(status::kBadRequest, why), now_ns); };
  const auto body = body_length(head);
  if (!head.has_word("upgrade", "websocket") || head.field("upgrade").find(',') != std::string::npos ||
      !head.has_word("connection", "upgrade") || request.method != Method::Get || request.close || !body || *body > 0) {
    return bad("the only upgrade is a GET that asks for 'websocket'");
  }
  const std::string accept = keys::web_socket_accept(head.field("sec-websocket-key"));
  if (head.field("sec-websocket-version") != "13" || accept.empty()) {
    return bad("a WebSocket needs Sec-WebSocket-Version: 13 and a key of 16 bytes");
  }
  request.stream = true;
  request.background = true;  // a page opens its stream again on its own, and this server checks it
  request.subprotocol = common_.house->choose_subprotocol(request);
  request_ = std::move(request);
  if (auto refused = common_.house->refuse(request_)) {
    return refuse(std::move(*refused), now_ns);
  }
  if (request_.subprotocol.empty()) {
    return bad("a WebSocket needs the subprotocol indurop.v1");
  }
  const bool unknown = request_.client.role == Role::Unknown;
  const std::size_t most = common_.settings.most_streams;
  const std::size_t reserve = common_.settings.reserve_streams ? most / kReserve : 0;
  if (common_.streams >= most || (unknown && common_.unknown_streams >= most - reserve)) {
    return refuse(refusal(status::kUnavailable, "there are too many clients; see --clients"), now_ns);
  }
  return open_stream(accept, now_ns);
}

bool Connection::open_stream(const std::string& accept, std::int64_t now_ns) {
  output_ += fmt::format(
      "HTTP/1.1 101 Switching Protocols\r\n"
      "upgrade: websocket\r\n"
      "connection: Upgrade\r\n"
      "sec-websocket-accept: {}\r\n"
      "sec-websocket-protocol: {}\r\n"
      "\r\n",
      accept, request_.subprotocol);
  visitor_ = common_.house->receive(request_, *this);
  ++common_.streams;
  common_.unknown_streams += request_.client.role == Role::Unknown ? 1 : 0;
  received_ns_ = now_ns;
  enter(Phase::Stream, kPingNs, now_ns);
  asked_ = true;
  return read_frames(now_ns);
}

bool Connection::read_frames(std::int64_t now_ns) {
  if (!input_.empty()) {
    received_ns_ = now_ns;
  }
  const std::string bytes = std::exchange(input_, {});
  const int code =
      frames_.feed(bytes, [this](base::FrameKind kind, const std::string& data) { return take_frame(kind, data); });
  if (output_.size() > kMostOutput) {
    return false;  // it keeps sending pings without reading the answers
  }
  return code == 0 || close_stream(code, now_ns);
}

int Connection::take_frame(base::FrameKind kind, const std::string& data) {
  switch (kind) {
    case base::FrameKind::Text:
      return visitor_->receive(data);
    case base::FrameKind::Ping:
      output_ += base::frame_header(base::FrameKind::Pong, data.size()) + data;
      return 0;
    case base::FrameKind::Close: {
      constexpr unsigned kByteBits = 8;
      constexpr int kNormal = 1000;
      if (data.empty()) {
        return kNormal;
      }
      const int code = data.size() < 2 ? 0
                                       : static_cast<int>(static_cast<unsigned char>(data[0]) << kByteBits |
                                                          static_cast<unsigned char>(data[1]));
      return base::is_close_code(code) ? code : base::close_code::kProtocol;
    }
    default:
      return 0;
  }
}

// Takes the next frame, if there is one and the stream is open.
bool Connection::next_message() {
  if (phase_ != Phase::Stream || !asked_) {
    return false;
  }
  message_ = visitor_->next();
  message_sent_ = 0;
  if (message_ == nullptr) {
    asked_ = false;
    return false;
  }
  const std::string header =
      base::frame_header(message_->binary ? base::FrameKind::Binary : base::FrameKind::Text, message_->size());
  std::copy(header.begin(), header.end(),
            message_->bytes.begin() + static_cast<std::ptrdiff_t>(Message::kRoom - header.size()));
  message_begin_ = Message::kRoom - header.size();
  return true;
}

std::string_view Connection::rest_of_message() const {
  const std::size_t at = message_begin_ + message_sent_;
  return {reinterpret_cast<const char*>(message_->bytes.data()) + at, message_->bytes.size() - at};
}

// Discards waiting messages; a frame that was begun is completed first.
bool Connection::close_stream(int code, std::int64_t now_ns) {
  output_ += base::close_frame(code);
  if (message_ != nullptr && message_sent_ == 0) {
    message_.reset();
  }
  close_ = true;
  enter(Phase::Sending, kClosingNs, now_ns);
  return true;
}

bool Connection::stream_on_time(std::int64_t now_ns) {
  if (now_ns - received_ns_ >= kSilentNs) {
    return false;
  }
  deadline_ns_ = now_ns + kPingNs;
  // The token or certificate that was valid at the beginning may have been revoked.
  read_certificate();
  if (common_.house->refuse(request_)) {
    return close_stream(base::close_code::kNotAllowed, now_ns);
  }
  output_ += base::frame_header(base::FrameKind::Ping, 0);
  return true;
}

}  // namespace indurop::serve
