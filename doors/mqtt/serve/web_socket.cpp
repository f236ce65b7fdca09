// SPDX-License-Identifier: Apache-2.0
#include "doors/mqtt/serve/web_socket.h"

#include <fmt/format.h>
#include <openssl/evp.h>
#include <openssl/rand.h>

#include <array>

namespace indurop::mqtt {
namespace {

constexpr unsigned kContinuation = 0;
constexpr unsigned kText = 1;
constexpr unsigned kBinary = 2;
constexpr unsigned kClose = 8;
constexpr unsigned kPing = 9;
constexpr unsigned kPong = 10;
constexpr unsigned kFinal = 0x80;
constexpr unsigned kMasked = 0x80;
constexpr unsigned kLength16 = 126;  // the length follows in 2 bytes
constexpr unsigned kLength64 = 127;  // the length follows in 8 bytes
constexpr unsigned kByteBits = 8;
constexpr std::size_t kMaskSize = 4;
constexpr std::uint64_t kMostMessageBytes = std::uint64_t{64} << 20U;

unsigned byte_of(const std::string& text, std::size_t at) {
  return static_cast<unsigned char>(text[at]);
}

std::string base64(const unsigned char* bytes, std::size_t size) {
  std::string text(4 * ((size + 2) / 3) + 1, '\0');
  const int length = EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()), bytes, static_cast<int>(size));
  text.resize(static_cast<std::size_t>(length));
  return text;
}

// The server's answer to a key (RFC 6455, 4.2.2).
std::string accept_of(const std::string& key) {
  const std::string text = key + "258EAFA5-E914-47DA-95CA-C5AB0DC85B11";
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned size = 0;
  EVP_Digest(text.data(), text.size(), digest.data(), &size, EVP_sha1(), nullptr);
  return base64(digest.data(), size);
}

}  // namespace

std::string client_frame(unsigned opcode, std::string_view payload) {
  std::string out;
  out += static_cast<char>(kFinal | opcode);
  constexpr std::size_t kMost16 = 0xffff;
  const std::size_t length_bytes = payload.size() < kLength16 ? 0 : payload.size() <= kMost16 ? 2 : 8;
  const unsigned short_length = length_bytes == 0   ? static_cast<unsigned>(payload.size())
                                : length_bytes == 2 ? kLength16
                                                    : kLength64;
  out += static_cast<char>(kMasked | short_length);
  for (std::size_t i = length_bytes; i-- > 0;) {
    out += static_cast<char>(static_cast<std::uint64_t>(payload.size()) >> (kByteBits * i));
  }
  std::array<unsigned char, kMaskSize> mask{};
  RAND_bytes(mask.data(), static_cast<int>(mask.size()));
  out.append(reinterpret_cast<const char*>(mask.data()), mask.size());
  for (std::size_t i = 0; i < payload.size(); ++i) {
    out += static_cast<char>(static_cast<unsigned char>(payload[i]) ^ mask.at(i % kMaskSize));
  }
  return out;
}

bool FrameParser::feed(std::string_view bytes, std::vector<Message>& to) {
  pending_ += bytes;
  for (bool complete = true; complete;) {
    if (!take(to, complete)) {
      return false;
    }
  }
  return true;
}

bool FrameParser::take(std::vector<Message>& to, bool& complete) {
  complete = false;
  if (pending_.size() < 2) {
    return true;
  }
  const unsigned second = byte_of(pending_, 1);
  const std::size_t length_bytes = second == kLength16 ? 2 : second == kLength64 ? 8 : 0;
  if ((second & kMasked) != 0 || pending_.size() < 2 + length_bytes) {
    return (second & kMasked) == 0;
  }
  std::uint64_t size = length_bytes == 0 ? second : 0;
  for (std::size_t i = 0; i < length_bytes; ++i) {
    size = (size << kByteBits) | byte_of(pending_, 2 + i);
  }
  if (size > kMostMessageBytes - message_.size()) {
    return false;
  }
  const std::size_t begin = 2 + length_bytes;
  if (pending_.size() < begin + size) {
    return true;
  }
  const unsigned first = byte_of(pending_, 0);
  std::string payload = pending_.substr(begin, size);
  pending_.erase(0, begin + size);
  complete = true;
  const unsigned opcode = first & ~kFinal;
  if (opcode == kClose || opcode == kPing || opcode == kPong) {
    if (opcode != kPong) {
      to.push_back({opcode == kPing ? Kind::Ping : Kind::Close, std::move(payload)});
    }
    return true;
  }
  if (opcode > kBinary || (opcode == kContinuation) != in_message_) {
    return false;
  }
  kind_ = opcode == kText ? Kind::Text : opcode == kBinary ? Kind::Binary : kind_;
  message_ += payload;
  in_message_ = (first & kFinal) == 0;
  if (!in_message_) {
    to.push_back({kind_, std::move(message_)});
    message_.clear();
  }
  return true;
}

Result<WebSocket, base::Problem> WebSocket::open(const ServeAccess& access, std::string_view path,
                                                 std::string_view protocol, const std::string& token) {
  auto connection = Connection::open(access.address, access.ca);
  if (!connection) {
    return std::move(connection).error();
  }
  std::array<unsigned char, 16> random{};
  RAND_bytes(random.data(), static_cast<int>(random.size()));
  const std::string key = base64(random.data(), random.size());
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
  if (end == std::string::npos || got.find(accept_of(key)) > end || !got.starts_with("HTTP/1.1 101")) {
    const auto json = base::Json::parse(end != std::string::npos ? std::string_view(got).substr(end + 4) : "");
    const std::string why = json ? (*json)["message"].text().value_or("") : std::string();
    return base::Problem{
        fmt::format("{} does not offer its stream{}{}", access.address.host_and_port(), why.empty() ? "" : ": ", why)};
  }
  WebSocket socket(std::move(*connection));
  socket.first_ = got.substr(end + 4);
  return socket;
}

Result<void, base::Problem> WebSocket::send(std::string_view text) {
  return connection_.send(client_frame(kText, text));
}

Result<std::vector<WebSocketMessage>, base::Problem> WebSocket::receive(std::chrono::milliseconds wait) {
  std::string got = std::move(first_);
  first_.clear();
  if (got.empty()) {
    if (auto received = connection_.receive(got, wait); !received) {
      return std::move(received).error();
    }
  }
  std::vector<FrameParser::Message> all;
  if (!frames_.feed(got, all)) {
    return base::Problem{"the server sent no frames of a WebSocket"};
  }
  std::vector<WebSocketMessage> messages;
  for (FrameParser::Message& one : all) {
    if (one.kind == FrameParser::Kind::Close) {
      return base::Problem{"the server closed the stream"};
    }
    if (one.kind == FrameParser::Kind::Ping) {
      if (auto sent = connection_.send(client_frame(kPong, one.bytes)); !sent) {
        return std::move(sent).error();
      }
      continue;
    }
    messages.push_back({one.kind == FrameParser::Kind::Binary, std::move(one.bytes)});
  }
  return messages;
}

}  // namespace indurop::mqtt
