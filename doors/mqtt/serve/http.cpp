// SPDX-License-Identifier: Apache-2.0
#include "doors/mqtt/serve/http.h"

#include <fmt/format.h>

#include <cctype>
#include <charconv>
#include <chrono>

#include "doors/mqtt/serve/connection.h"

namespace indurop::mqtt {
namespace {

constexpr std::size_t kMostAnswerBytes = std::size_t{16} << 20U;
constexpr std::chrono::seconds kAnswerPatience{15};  // a board of another host may take some

// Returns the value of a header line, whose name is in lower case; empty: there is none.
std::string header_of(std::string_view head, std::string_view name) {
  std::string lower(head);
  for (char& c : lower) {
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  const auto at = lower.find(fmt::format("\r\n{}:", name));
  if (at == std::string::npos) {
    return {};
  }
  const auto begin = lower.find_first_not_of(' ', at + name.size() + 3);
  return std::string(head.substr(begin, lower.find("\r\n", begin) - begin));
}

// Returns the number; 0 if there is none.
std::size_t number_in(std::string_view text) {
  std::size_t number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

}  // namespace

std::string request_head(const ServeAccess& access, std::string_view method, std::string_view path,
                         std::string_view token, std::string_view more) {
  return fmt::format("{} {} HTTP/1.1\r\nhost: {}\r\n{}{}\r\n", method, path, access.address.host_and_port(),
                     token.empty() ? std::string() : fmt::format("authorization: Bearer {}\r\n", token), more);
}

Result<HttpReply, base::Problem> ask(const ServeAccess& access, std::string_view method, std::string_view path,
                                     std::string_view token, std::string_view body) {
  auto connection = Connection::open(access.address, access.ca);
  if (!connection) {
    return std::move(connection).error();
  }
  std::string more = "connection: close\r\n";
  if (!body.empty()) {
    more += fmt::format("content-type: application/json\r\ncontent-length: {}\r\n", body.size());
  }
  if (auto sent = connection->send(request_head(access, method, path, token, more) + std::string(body)); !sent) {
    return std::move(sent).error();
  }
  const base::Problem no_answer{fmt::format("{} does not answer", access.address.host_and_port())};
  const auto deadline = std::chrono::steady_clock::now() + kAnswerPatience;
  std::string got;
  std::size_t end = std::string::npos;
  std::size_t whole = SIZE_MAX;
  while (got.size() < whole) {
    if (std::chrono::steady_clock::now() > deadline || got.size() > kMostAnswerBytes ||
        !connection->receive(got, std::chrono::seconds(1))) {
      return no_answer;
    }
    if (end == std::string::npos && (end = got.find("\r\n\r\n")) != std::string::npos) {
      whole = end + 4 + number_in(header_of(std::string_view(got).substr(0, end + 2), "content-length"));
    }
  }
  constexpr std::string_view kVersion = "HTTP/1.1 ";
  if (!got.starts_with(kVersion)) {
    return no_answer;
  }
  const int status = static_cast<int>(number_in(std::string_view(got).substr(kVersion.size(), 3)));
  return HttpReply{status, got.substr(end + 4, whole - end - 4)};
}

std::string path_part(std::string_view name) {
  std::string out;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    out +=
        std::isalnum(byte) != 0 || c == '_' || c == '-' || c == '.' ? std::string(1, c) : fmt::format("%{:02X}", byte);
  }
  return out;
}

}  // namespace indurop::mqtt
