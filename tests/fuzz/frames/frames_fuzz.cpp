// SPDX-License-Identifier: Apache-2.0
// Whatever bytes come as frames: the messages and the code to close with are those that a reader of whole buffers,
// written here from RFC 6455, finds, in whatever parts the bytes come. The first byte chooses the parts and the limit.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/web_socket_frames.h"

namespace {

using indurop::base::FrameKind;
using Message = std::pair<FrameKind, std::string>;

struct Heard {
  std::vector<Message> messages;
  int code = 0;
  bool operator==(const Heard&) const = default;
};

constexpr int kProtocol = 1002;
constexpr int kNotUnderstood = 1003;
constexpr int kTooLarge = 1009;

// What the header at `at` says; complete once `bytes` reach to the payload.
struct Header {
  bool final = false;
  unsigned opcode = 0;
  std::uint64_t size = 0;
  std::size_t length = 0;  // of the header
  int code = 0;            // wrong by its first two bytes
  bool shortest = true;
};

Header header_at(std::string_view bytes, bool within_message) {
  const auto byte = [&](std::size_t at) { return at < bytes.size() ? static_cast<unsigned char>(bytes[at]) : 0U; };
  Header header;
  header.final = byte(0) >= 128;
  header.opcode = byte(0) % 16;
  const bool reserved = byte(0) / 16 % 8 != 0;
  const bool masked = byte(1) >= 128;
  const unsigned size = byte(1) % 128;
  const bool control = header.opcode == 8 || header.opcode == 9 || header.opcode == 10;
  const bool data = header.opcode <= 2;
  if (reserved || !masked || (!control && !data)) {
    header.code = kProtocol;
  } else if (control) {
    header.code = header.final && size <= 125 ? 0 : kProtocol;
  } else if ((header.opcode == 0) != within_message) {
    header.code = kProtocol;
  } else if (header.opcode == 2) {
    header.code = kNotUnderstood;
  }
  const std::size_t more = size == 126 ? 2 : size == 127 ? 8 : 0;
  header.size = more == 0 ? size : 0;
  for (std::size_t i = 0; i < more; ++i) {
    header.size = header.size * 256 + byte(2 + i);
  }
  header.shortest = more == 0 || (more == 2 ? header.size > 125 : header.size > 65535);
  header.length = 2 + more + 4;
  return header;
}

Heard read_whole(std::string_view bytes, std::size_t most) {
  Heard heard;
  std::string message;
  FrameKind kind = FrameKind::Text;
  bool within = false;
  while (bytes.size() >= 2) {
    const Header header = header_at(bytes, within);
    if (header.code != 0) {
      heard.code = header.code;
      return heard;
    }
    if (bytes.size() < header.length) {
      return heard;
    }
    const bool control = header.opcode >= 8;
    if (!header.shortest || (!control && header.size > most - message.size())) {
      heard.code = header.shortest ? kTooLarge : kProtocol;
      return heard;
    }
    within = within || !control;
    kind = header.opcode == 1 ? FrameKind::Text : kind;
    if (bytes.size() - header.length < header.size) {
      return heard;
    }
    std::string payload(bytes.substr(header.length, header.size));
    for (std::size_t i = 0; i < payload.size(); ++i) {
      payload[i] = static_cast<char>(payload[i] ^ bytes[header.length - 4 + i % 4]);
    }
    bytes.remove_prefix(header.length + header.size);
    if (control) {
      heard.messages.emplace_back(static_cast<FrameKind>(header.opcode), payload);
      continue;
    }
    message += payload;
    if (header.final) {
      heard.messages.emplace_back(kind, std::exchange(message, {}));
      within = false;
    }
  }
  return heard;
}

Heard read_in_parts(std::string_view bytes, std::size_t most, std::size_t part) {
  indurop::base::FrameReader reader(indurop::base::FrameSender::Client, most);
  Heard heard;
  while (!bytes.empty() && heard.code == 0) {
    heard.code = reader.feed(bytes.substr(0, part), [&heard](FrameKind kind, const std::string& data) {
      heard.messages.emplace_back(kind, data);
      return 0;
    });
    bytes.remove_prefix(part < bytes.size() ? part : bytes.size());
  }
  return heard;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) {
    return 0;
  }
  const std::size_t part = 1 + data[0] % 16;
  const std::size_t most = data[0] / 16 * std::size_t{20};
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  const Heard expected = read_whole(bytes, most);
  if (read_in_parts(bytes, most, part) != expected || read_in_parts(bytes, most, size) != expected) {
    std::abort();
  }
  for (const auto& [kind, text] : expected.messages) {  // a client reads the server's own header in the same way
    const std::string header = indurop::base::frame_header(kind, text.size());
    if (header.size() != (text.size() < 126 ? 2U : 4U) || (static_cast<unsigned char>(header[1]) & 0x80U) != 0) {
      std::abort();
    }
  }
  return 0;
}
