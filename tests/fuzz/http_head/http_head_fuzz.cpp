// SPDX-License-Identifier: Apache-2.0
// Whatever bytes come for a head: it is refused, or it has one meaning only. What that is, is looked for in the bytes
// themselves, not with the reader's own functions.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <utility>

#include "tools/serve/door/access_gate.h"
#include "tools/serve/door/door.h"
#include "tools/serve/door/http_head.h"

namespace {

using indurop::serve::Head;

void demand(bool holds) {
  if (!holds) {
    std::abort();
  }
}

bool is_control(char c) {
  return (static_cast<unsigned char>(c) < ' ' && c != '\t') || c == '\x7f';
}

// Line by line as anybody else would read it: ends of lines are CR LF, no line is folded, no field counts twice.
void check_lines(std::string_view text, const Head& head) {
  std::size_t lines = 0;
  std::size_t hosts = 0;
  std::size_t lengths = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at);
    demand(end != std::string_view::npos && end > at && text[end - 1] == '\r');
    const std::string_view line = text.substr(at, end - 1 - at);
    demand(std::none_of(line.begin(), line.end(), is_control));
    at = end + 1;
    if (line.empty()) {
      demand(at == text.size());
      break;
    }
    demand(line.front() != ' ' && line.front() != '\t');
    std::string name(line.substr(0, line.find(':')));
    for (char& c : name) {
      c = c >= 'A' && c <= 'Z' ? static_cast<char>(c | 0x20) : c;
    }
    hosts += lines > 0 && name == "host" ? 1U : 0U;
    lengths += lines > 0 && name == "content-length" ? 1U : 0U;
    ++lines;
  }
  demand(hosts == 1 && lengths <= 1 && head.fields.size() + 1 == lines);
}

// The same head, written out again, is read as the same.
void read_again(const Head& head) {
  std::string text = head.method + " /";
  for (const char c : head.path.substr(1)) {
    constexpr std::string_view kDigits = "0123456789ABCDEF";
    const auto byte = static_cast<unsigned char>(c);
    text += {'%', kDigits[byte / 16], kDigits[byte % 16]};
  }
  text += " HTTP/1.1\r\n";
  for (const auto& [name, value] : head.fields) {
    text += name;
    text += ": " + value + "\r\n";
  }
  const auto again = indurop::serve::read_head(text + "\r\n");
  demand(again && again->method == head.method && again->path == head.path && again->fields == head.fields);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  const std::size_t length = indurop::serve::head_length(input);
  demand(length <= size && (length == 0 || input.substr(0, length).ends_with("\r\n\r\n")));
  for (std::size_t part = 0; part < length; ++part) {
    demand(indurop::serve::head_length(input.substr(0, part)) == 0);
  }
  const auto head = indurop::serve::read_head(input.substr(0, length));
  if (!head) {
    demand(head.error().status == 400 || head.error().status == 431);
    (void)indurop::serve::head_of(head.error());
    return 0;
  }
  demand(!head->method.empty() && head->path.starts_with('/') && head->path.find('\0') == std::string::npos);
  check_lines(input.substr(0, length), *head);
  read_again(*head);
  if (const auto body = indurop::serve::body_length(*head)) {
    demand(*body <= indurop::serve::kMostBody && (*body == 0 || head->method == "POST"));
    demand(head->field("transfer-encoding").empty());
  }
  const indurop::serve::Request request = indurop::serve::request_of(*head);
  const std::string name = indurop::serve::host_name(request.host);
  demand(name.size() <= request.host.size());
  (void)head->has_word("connection", "upgrade");
  return 0;
}
