// SPDX-License-Identifier: Apache-2.0
// Parses the head of an HTTP/1.1 request. It is strict, because attacks use what two readers could understand in two
// ways (a second Host, a bare line feed, a folded field). Pure text, no sockets.

#pragma once

#include <indurop/result.h>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tools/serve/door/request.h"

namespace indurop::serve {

inline constexpr std::size_t kMostHead = 8192;

struct Head {
  std::string method;
  std::string path;  // decoded
  std::vector<std::pair<std::string, std::string>> query;
  bool keeps_open = true;                                   // the connection stays open for further requests
  std::vector<std::pair<std::string, std::string>> fields;  // names in lower case

  // Returns the values of all fields of this name, separated by commas; empty: none.
  [[nodiscard]] std::string field(std::string_view name) const;
  // Returns whether `word` is one of the comma-separated words of this field, ignoring case.
  [[nodiscard]] bool has_word(std::string_view name, std::string_view word) const;
};

// Returns the length of the head at the beginning of `input`, with its empty line; 0: it is not complete yet.
std::size_t head_length(std::string_view input);
// Parses a head, `text` of that length; or returns the refusal.
Result<Head, Reply> read_head(std::string_view text);

// Returns the announced length of the body, or the refusal.
Result<std::size_t, Reply> body_length(const Head& head);
// Returns the parts of the head that the rest of the server uses.
Request request_of(const Head& head);

// Returns status line and fields of a reply.
std::string head_of(const Reply& reply);

}  // namespace indurop::serve
