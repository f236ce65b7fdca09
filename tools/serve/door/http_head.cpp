// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/door/http_head.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "core/base/text.h"
#include "tools/serve/door/door.h"

namespace indurop::serve {
namespace {

constexpr std::size_t kMostFields = 100;
constexpr std::string_view kEnd = "\r\n";
constexpr std::string_view kHeadEnd = "\r\n\r\n";

// Fields that may occur once only: with two of them it is ambiguous which one counts.
constexpr std::array kOnce{"host",
                           "origin",
                           "authorization",
                           "content-length",
                           "content-type",
                           "transfer-encoding",
                           "sec-fetch-site",
                           "sec-websocket-key",
                           "sec-websocket-version"};

char lower_letter(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

bool equal_but_case(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return lower_letter(x) == lower_letter(y); });
}

// Returns true for a character of a method or of a field's name.
bool is_token(unsigned char c) {
  constexpr std::string_view kMarks = "!#$%&'*+-.^_`|~";
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
         kMarks.find(static_cast<char>(c)) != std::string_view::npos;
}

bool all_token(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) { return is_token(c); });
}

bool is_visible(unsigned char c) {
  constexpr unsigned char kDelete = 0x7f;
  return c > ' ' && c != kDelete;
}

Reply bad(const char* why) {
  return refusal(status::kBadRequest, why);
}

int digit_of(char c) {
  if (c >= '0' && c <= '9') {
    return c - '0';
  }
  if (c >= 'a' && c <= 'f') {
    return c - 'a' + 10;
  }
  if (c >= 'A' && c <= 'F') {
    return c - 'A' + 10;
  }
  return -1;
}

// Decodes "%3A" to ":", and in a query "+" to a blank; returns nothing if the text is invalid.
std::optional<std::string> decoded(std::string_view text, bool query) {
  constexpr int kBase = 16;
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      out += query && text[i] == '+' ? ' ' : text[i];
      continue;
    }
    const int high = i + 2 < text.size() ? digit_of(text[i + 1]) : -1;
    const int low = i + 2 < text.size() ? digit_of(text[i + 2]) : -1;
    if (high < 0 || low < 0 || (high == 0 && low == 0)) {
      return std::nullopt;
    }
    out += static_cast<char>(high * kBase + low);
    i += 2;
  }
  return out;
}

bool read_query(std::string_view text, Head& head) {
  while (!text.empty()) {
    const std::string_view one = text.substr(0, text.find('&'));
    text.remove_prefix(std::min(one.size() + 1, text.size()));
    const auto equals = one.find('=');
    auto name = decoded(one.substr(0, equals), true);
    auto value = decoded(equals == std::string_view::npos ? std::string_view() : one.substr(equals + 1), true);
    if (!name || !value) {
      return false;
    }
    if (!one.empty()) {
      head.query.emplace_back(std::move(*name), std::move(*value));
    }
  }
  return true;
}

std::optional<Reply> read_target(std::string_view target, Head& head) {
  const bool visible =
      std::all_of(target.begin(), target.end(), [](unsigned char c) { return is_visible(c) && c < 0x80; });
  if (!target.starts_with('/') || !visible || target.find('#') != std::string_view::npos) {
    return bad("the target of a request is a path that begins with '/'");
  }
  const auto question = target.find('?');
  auto path = decoded(target.substr(0, question), false);
  if (!path || (question != std::string_view::npos && !read_query(target.substr(question + 1), head))) {
    return bad("a '%' in the target is followed by two hexadecimal digits, not both 0");
  }
  head.path = std::move(*path);
  return std::nullopt;
}

std::optional<Reply> read_first_line(std::string_view line, Head& head) {
  const auto first = line.find(' ');
  const auto last = line.rfind(' ');
  if (first == std::string_view::npos || first == last) {
    return bad("a request begins with METHOD PATH HTTP/1.1");
  }
  const std::string_view version = line.substr(last + 1);
  if (version != "HTTP/1.1" && version != "HTTP/1.0") {
    return bad("only HTTP/1.1 is supported");
  }
  head.keeps_open = version == "HTTP/1.1";
  head.method = line.substr(0, first);
  if (!all_token(head.method)) {
    return bad("a request begins with METHOD PATH HTTP/1.1");
  }
  return read_target(line.substr(first + 1, last - first - 1), head);
}

std::optional<Reply> read_field(std::string_view line, Head& head) {
  const auto colon = line.find(':');
  const std::string_view name = line.substr(0, colon);
  if (colon == std::string_view::npos || !all_token(name)) {
    return bad("a header is NAME: value, on one line");
  }
  // Also at both ends: other readers interpret a line feed there as the end of the line.
  if (!std::all_of(line.begin(), line.end(), [](unsigned char c) { return c == ' ' || c == '\t' || is_visible(c); })) {
    return bad("a header has a control character");
  }
  const std::string_view value = base::trimmed(line.substr(colon + 1));
  std::string small(name);
  std::transform(small.begin(), small.end(), small.begin(), &lower_letter);
  const bool known =
      std::any_of(head.fields.begin(), head.fields.end(), [&small](const auto& field) { return field.first == small; });
  if (known && std::find(kOnce.begin(), kOnce.end(), small) != kOnce.end()) {
    return refusal(status::kBadRequest, fmt::format("the header {} is given twice", small));
  }
  if (head.fields.size() >= kMostFields) {
    return refusal(status::kHeadTooLarge, "there are too many headers");
  }
  head.fields.emplace_back(std::move(small), value);
  return std::nullopt;
}

std::string_view reason_of(int code) {
  return code == status::kOk ? "OK" : word_of(code);
}

}  // namespace

std::string Head::field(std::string_view name) const {
  std::string all;
  for (const auto& [known, value] : fields) {
    if (known == name) {
      all += (all.empty() ? "" : ", ") + value;
    }
  }
  return all;
}

bool Head::has_word(std::string_view name, std::string_view word) const {
  const std::string all = field(name);
  for (std::string_view rest = all; !rest.empty();) {
    const std::string_view one = rest.substr(0, rest.find(','));
    if (equal_but_case(base::trimmed(one), word)) {
      return true;
    }
    rest.remove_prefix(std::min(one.size() + 1, rest.size()));
  }
  return false;
}

std::size_t head_length(std::string_view input) {
  const auto end = input.find(kHeadEnd);
  return end == std::string_view::npos ? 0 : end + kHeadEnd.size();
}

Result<Head, Reply> read_head(std::string_view text) {
  Head head;
  text.remove_suffix(std::min(text.size(), kEnd.size()));  // the empty line
  bool first = true;
  while (!text.empty()) {
    const auto end = text.find(kEnd);
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + kEnd.size());
    if (auto wrong = first ? read_first_line(line, head) : read_field(line, head)) {
      return std::move(*wrong);
    }
    first = false;
  }
  if (first) {
    return bad("a request begins with METHOD PATH HTTP/1.1");
  }
  if (head.field("host").empty()) {
    return bad("a request names one Host");
  }
  head.keeps_open = head.keeps_open && !head.has_word("connection", "close");
  return head;
}

Result<std::size_t, Reply> body_length(const Head& head) {
  std::size_t bytes = 0;
  if (!head.field("transfer-encoding").empty()) {
    return bad("the body has to come whole, with Content-Length");
  }
  const bool announced = std::any_of(head.fields.begin(), head.fields.end(),
                                     [](const auto& field) { return field.first == "content-length"; });
  const std::string text = head.field("content-length");
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), bytes);
  if (!announced) {
    return bytes;
  }
  if (parsed.ec == std::errc::result_out_of_range || (parsed.ec == std::errc() && bytes > kMostBody)) {
    return refusal(status::kTooLarge, fmt::format("a body has at most {} bytes", kMostBody));
  }
  if (parsed.ec != std::errc() || parsed.ptr != text.data() + text.size()) {
    return bad("Content-Length is no number");
  }
  if (bytes > 0 && head.method != "POST") {
    return bad("only a POST has a body");
  }
  return bytes;
}

Request request_of(const Head& head) {
  Request request;
  request.method = head.method == "GET" ? Method::Get : head.method == "POST" ? Method::Post : Method::Other;
  request.path = head.path;
  request.query = head.query;
  request.host = head.field("host");
  request.origin = head.field("origin");
  request.fetch_site = head.field("sec-fetch-site");
  request.authorization = head.field("authorization");
  request.subprotocols = head.field("sec-websocket-protocol");
  request.content_type = head.field("content-type");
  request.close = !head.keeps_open;
  request.background = head.has_word("indurop-background", "true");
  return request;
}

std::string head_of(const Reply& reply) {
  std::string text = fmt::format(
      "HTTP/1.1 {} {}\r\n"
      "server: indurop\r\n"
      "content-type: {}\r\n"
      "content-length: {}\r\n"
      "cache-control: {}\r\n"
      "x-content-type-options: nosniff\r\n"
      "x-frame-options: DENY\r\n"
      "referrer-policy: no-referrer\r\n"
      "cross-origin-resource-policy: same-origin\r\n"
      "content-security-policy: default-src 'self'; img-src 'self' data: blob:; style-src 'self' 'unsafe-inline'; "
      "connect-src 'self' ws: wss:; frame-ancestors 'none'; base-uri 'none'; form-action 'none'\r\n",
      reply.status, reason_of(reply.status), reply.type, reply.body.size(),
      reply.immutable ? "public, max-age=31536000, immutable" : "no-store");
  const auto add = [&text](bool wanted, std::string_view name, std::string_view value) {
    text += wanted ? fmt::format("{}: {}\r\n", name, value) : "";
  };
  add(reply.close, "connection", "close");
  add(!reply.allow.empty(), "allow", reply.allow);
  add(reply.status == status::kUnauthorized, "www-authenticate", "Bearer");
  return text + "\r\n";
}

}  // namespace indurop::serve
