// SPDX-License-Identifier: Apache-2.0
// WebSocket frames (RFC 6455) as a server reads and writes them. No extensions. Pure bytes, no sockets.

#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace indurop::serve {

enum class FrameKind : unsigned char { More = 0, Text = 1, Binary = 2, Close = 8, Ping = 9, Pong = 10 };

// Takes bytes in pieces of any size and returns whole messages, reassembled and unmasked.
class FrameReader {
 public:
  explicit FrameReader(std::size_t most) : most_(most) {}
  // Receives a message; a result other than 0 is the code to close with.
  using Take = std::function<int(FrameKind kind, const std::string& data)>;
  // Parses these bytes. A result other than 0 is the code to close with; nothing may be fed after it.
  int feed(std::string_view bytes, const Take& take);

 private:
  int read_header();
  int begin_frame(unsigned first, unsigned second);
  int end_frame(const Take& take);
  [[nodiscard]] bool is_control() const noexcept { return kind_ >= FrameKind::Close; }

  std::size_t most_;
  std::string header_;  // header of the current frame, as far as received
  bool in_payload_ = false;
  FrameKind kind_ = FrameKind::Text;  // kind of the frame
  bool final_ = false;
  std::uint64_t left_ = 0;   // remaining bytes of its payload
  std::size_t at_ = 0;       // position in the payload
  std::string control_;      // payload of a control frame
  std::string message_;      // payload of the message so far
  bool in_message_ = false;  // more frames of it follow
  FrameKind message_kind_ = FrameKind::Text;
};

// Returns the header for a payload of `size` bytes from a server, at most 10 bytes.
std::string frame_header(FrameKind kind, std::size_t size);
// Returns a whole close frame. `code` 0: without a code.
std::string close_frame(int code);
// Returns whether this code is allowed in a close frame.
bool is_close_code(int code) noexcept;

}  // namespace indurop::serve
