// SPDX-License-Identifier: Apache-2.0
// Frames of a WebSocket (RFC 6455), as a server reads and writes them. No extensions. Pure bytes, no sockets.

#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace indurop::serve {

enum class FrameKind : unsigned char { More = 0, Text = 1, Binary = 2, Close = 8, Ping = 9, Pong = 10 };

// Takes bytes in parts of any size and gives whole messages out, parts put together and without their mask.
class FrameReader {
 public:
  explicit FrameReader(std::size_t most) : most_(most) {}
  // Of a message; another result than 0 is the code to close with.
  using Take = std::function<int(FrameKind kind, const std::string& data)>;
  // Another result than 0 is the code to close with; nothing may be fed after it.
  int feed(std::string_view bytes, const Take& take);

 private:
  int read_header();
  int begin_frame(unsigned first, unsigned second);
  int end_frame(const Take& take);
  [[nodiscard]] bool is_control() const noexcept { return kind_ >= FrameKind::Close; }

  std::size_t most_;
  std::string header_;  // of the frame that comes, as far as it has come
  bool in_payload_ = false;
  FrameKind kind_ = FrameKind::Text;  // of the frame
  bool final_ = false;
  std::uint64_t left_ = 0;   // of the frame's payload
  std::size_t at_ = 0;       // in it
  std::string control_;      // payload of a control frame
  std::string message_;      // payload of the message so far
  bool in_message_ = false;  // more of it comes
  FrameKind message_kind_ = FrameKind::Text;
};

// What goes in front of `size` bytes from a server, at most 10 bytes.
std::string frame_header(FrameKind kind, std::size_t size);
// A whole close frame. 0: without a code.
std::string close_frame(int code);
// May this code stand in a close frame?
bool is_close_code(int code) noexcept;

}  // namespace indurop::serve
