// SPDX-License-Identifier: Apache-2.0
#include "core/base/web_socket_frames.h"

#include <algorithm>

namespace indurop::base {
namespace {

constexpr unsigned kFinal = 0x80;
constexpr unsigned kReserved = 0x70;
constexpr unsigned kOpcode = 0x0f;
constexpr unsigned kMasked = 0x80;
constexpr unsigned kLength = 0x7f;
constexpr unsigned kLength16 = 126;  // the length follows in 2 bytes
constexpr unsigned kLength64 = 127;  // the length follows in 8 bytes
constexpr std::uint64_t kMost16 = 0xffff;
constexpr unsigned kByteBits = 8;

unsigned byte_of(const std::string& text, std::size_t at) {
  return static_cast<unsigned char>(text[at]);
}

std::size_t length_size(unsigned second) {
  return (second & kLength) == kLength16 ? 2 : (second & kLength) == kLength64 ? 8 : 0;
}

std::uint64_t big_endian(const std::string& text, std::size_t at, std::size_t size) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < size; ++i) {
    value = (value << kByteBits) | byte_of(text, at + i);
  }
  return value;
}

}  // namespace

int FrameReader::feed(std::string_view bytes, const Take& take) {
  while (!bytes.empty() || (in_payload_ && left_ == 0)) {
    if (!in_payload_) {
      header_ += bytes.front();
      bytes.remove_prefix(1);
      if (const int code = read_header(); code != 0) {
        return code;
      }
      continue;
    }
    std::string& into = is_control() ? control_ : message_;
    const auto size = static_cast<std::size_t>(std::min<std::uint64_t>(left_, bytes.size()));
    if (mask_size() == 0) {
      into += bytes.substr(0, size);
    } else {
      const std::size_t mask = header_.size() - kMaskSize;
      for (std::size_t i = 0; i < size; ++i) {
        into +=
            static_cast<char>(byte_of(header_, mask + (at_ + i) % kMaskSize) ^ static_cast<unsigned char>(bytes[i]));
      }
    }
    bytes.remove_prefix(size);
    at_ += size;
    left_ -= size;
    if (left_ == 0) {
      if (const int code = end_frame(take); code != 0) {
        return code;
      }
    }
  }
  return 0;
}

// Processes another byte of the header. Errors are refused as early as possible.
int FrameReader::read_header() {
  if (header_.size() < 2) {
    return 0;
  }
  const unsigned second = byte_of(header_, 1);
  if (header_.size() == 2) {
    if (const int code = begin_frame(byte_of(header_, 0), second); code != 0) {
      return code;
    }
  }
  const std::size_t more = length_size(second);
  if (header_.size() < 2 + more + mask_size()) {
    return 0;
  }
  left_ = more == 0 ? second & kLength : big_endian(header_, 2, more);
  const bool shortest = more == 0 || (more == 2 ? left_ >= kLength16 : left_ > kMost16);
  if (!shortest) {
    return close_code::kProtocol;
  }
  if (!is_control() && left_ > most_ - message_.size()) {
    return close_code::kTooLarge;
  }
  at_ = 0;
  in_payload_ = true;
  return 0;
}

int FrameReader::begin_frame(unsigned first, unsigned second) {
  const unsigned opcode = first & kOpcode;
  const bool known =
      opcode <= static_cast<unsigned>(FrameKind::Binary) ||
      (opcode >= static_cast<unsigned>(FrameKind::Close) && opcode <= static_cast<unsigned>(FrameKind::Pong));
  final_ = (first & kFinal) != 0;
  const bool masked = (second & kMasked) != 0;
  if (!known || (first & kReserved) != 0 || masked != (sender_ == FrameSender::Client)) {
    return close_code::kProtocol;
  }
  kind_ = static_cast<FrameKind>(opcode);
  if (is_control()) {
    control_.clear();
    return final_ && (second & kLength) < kLength16 ? 0 : close_code::kProtocol;
  }
  if ((kind_ == FrameKind::More) != in_message_) {
    return close_code::kProtocol;
  }
  if (kind_ == FrameKind::Binary && sender_ == FrameSender::Client) {
    return close_code::kNotUnderstood;
  }
  message_kind_ = kind_ == FrameKind::More ? message_kind_ : kind_;
  in_message_ = true;
  return 0;
}

int FrameReader::end_frame(const Take& take) {
  in_payload_ = false;
  header_.clear();
  if (is_control()) {
    return take(kind_, control_);
  }
  if (!final_) {
    return 0;
  }
  in_message_ = false;
  const int code = take(message_kind_, message_);
  message_.clear();
  return code;
}

std::string frame_header(FrameKind kind, std::size_t size) {
  std::string header(1, static_cast<char>(kFinal | static_cast<unsigned>(kind)));
  const unsigned bytes = size < kLength16 ? 0 : size <= kMost16 ? 2 : 8;
  header += static_cast<char>(bytes == 0 ? size : bytes == 2 ? kLength16 : kLength64);
  for (unsigned i = bytes; i > 0; --i) {
    header += static_cast<char>((static_cast<std::uint64_t>(size) >> ((i - 1) * kByteBits)) & 0xffU);
  }
  return header;
}

std::string masked_frame(FrameKind kind, std::string_view payload, std::array<unsigned char, 4> mask) {
  std::string frame = frame_header(kind, payload.size());
  frame[1] = static_cast<char>(byte_of(frame, 1) | kMasked);
  frame.append(mask.begin(), mask.end());
  for (std::size_t i = 0; i < payload.size(); ++i) {
    frame += static_cast<char>(static_cast<unsigned char>(payload[i]) ^ mask.at(i % mask.size()));
  }
  return frame;
}

std::string close_frame(int code) {
  if (code == 0) {
    return frame_header(FrameKind::Close, 0);
  }
  const auto value = static_cast<unsigned>(code);
  return frame_header(FrameKind::Close, 2) + static_cast<char>(value >> kByteBits) + static_cast<char>(value & 0xffU);
}

bool is_close_code(int code) noexcept {
  constexpr int kFirst = 1000;
  constexpr int kLastOwn = 1014;
  constexpr int kFirstFree = 3000;
  constexpr int kLastFree = 4999;
  const bool never = code == 1004 || code == 1005 || code == 1006;
  return (code >= kFirst && code <= kLastOwn && !never) || (code >= kFirstFree && code <= kLastFree);
}

}  // namespace indurop::base
