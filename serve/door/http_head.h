// SPDX-License-Identifier: Apache-2.0
// The head of an HTTP/1.1 request as text: read strictly, because everything that two readers could understand in two
// ways (a second Host, a bare line feed, a folded field) is what attacks are made of. Pure text, no sockets.

#pragma once

#include <indurop/result.h>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "serve/door/request.h"

namespace indurop::serve {

inline constexpr std::size_t kMostHead = 8192;

struct Head {
  std::string method;
  std::string path;  // decoded
  std::vector<std::pair<std::string, std::string>> query;
  bool keeps_open = true;                                   // the connection, for further requests
  std::vector<std::pair<std::string, std::string>> fields;  // names in lower case

  // Values of all fields of this name, with commas between them; empty: none.
  [[nodiscard]] std::string field(std::string_view name) const;
  // Is `word` one of the comma-separated words of this field? Without regard to case.
  [[nodiscard]] bool has_word(std::string_view name, std::string_view word) const;
};

// Length of the head at the beginning of `input`, its empty line included; 0: it is not complete yet.
std::size_t head_length(std::string_view input);
// `text` of that length. Or why it is refused.
Result<Head, Reply> read_head(std::string_view text);

// Length of the body that is announced, or why it cannot be taken.
Result<std::size_t, Reply> body_length(const Head& head);
// What of the head the rest of the server looks at.
Request request_of(const Head& head);

// The key of a WebSocket's answer; empty: `key` is none.
std::string websocket_accept(std::string_view key);

// Status line and fields of a reply.
std::string head_of(const Reply& reply);

}  // namespace indurop::serve
