// SPDX-License-Identifier: Apache-2.0
// WebSocket frames (RFC 6455) as servers and clients read and write them. No extensions. Pure bytes, no sockets.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace indurop::base {

enum class FrameKind : unsigned char { More = 0, Text = 1, Binary = 2, Close = 8, Ping = 9, Pong = 10 };

// The codes of close frames in use (RFC 6455, 7.4.1).
namespace close_code {
inline constexpr int kProtocol = 1002;
inline constexpr int kNotUnderstood = 1003;
inline constexpr int kBadText = 1007;
inline constexpr int kNotAllowed = 1008;
inline constexpr int kTooLarge = 1009;
}  // namespace close_code

// A client has to mask what it sends, so that no proxy mistakes it for a request, and our clients send text only. A
// server must not mask.
enum class FrameSender : unsigned char { Client, Server };

// Takes bytes in pieces of any size and returns whole messages, reassembled and unmasked. Used by one thread.
class FrameReader {
 public:
  // `most`: bytes of a message.
  FrameReader(FrameSender sender, std::size_t most) : sender_(sender), most_(most) {}
  // Receives a message; a result other than 0 is the code to close with.
  using Take = std::function<int(FrameKind kind, const std::string& data)>;
  // Parses these bytes. A result other than 0 is the code to close with; nothing may be fed after it.
  int feed(std::string_view bytes, const Take& take);

 private:
  int read_header();
  int begin_frame(unsigned first, unsigned second);
  int end_frame(const Take& take);
  [[nodiscard]] std::size_t mask_size() const noexcept { return sender_ == FrameSender::Client ? kMaskSize : 0; }
  [[nodiscard]] bool is_control() const noexcept { return kind_ >= FrameKind::Close; }

  static constexpr std::size_t kMaskSize = 4;

  FrameSender sender_;
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
// Returns a whole frame from a client. `mask` has to be random for each frame.
std::string masked_frame(FrameKind kind, std::string_view payload, std::array<unsigned char, 4> mask);
// Returns a whole close frame from a server. `code` 0: without a code.
std::string close_frame(int code);
// Returns whether this code is allowed in a close frame.
bool is_close_code(int code) noexcept;

}  // namespace indurop::base
