// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/door/request.h"

#include <algorithm>
#include <array>

namespace indurop::serve {

std::string_view word_of(Role role) noexcept {
  constexpr std::array<std::string_view, 6> kWords{"unknown", "look", "operate", "tune", "program", "administer"};
  return kWords.at(static_cast<std::size_t>(role));
}

std::string_view word_of(int code) noexcept {
  constexpr std::array<std::pair<int, std::string_view>, 16> kWords{{
      {status::kBadRequest, "bad_request"},
      {status::kUnauthorized, "unauthorized"},
      {status::kForbidden, "forbidden"},
      {status::kNotFound, "not_found"},
      {status::kMethodNotAllowed, "method_not_allowed"},
      {status::kTimeout, "too_slow"},
      {status::kConflict, "conflict"},
      {status::kTooLarge, "too_large"},
      {status::kNotJson, "not_json"},
      {status::kMisdirected, "wrong_host"},
      {status::kWrongValue, "wrong_value"},
      {status::kLocked, "locked"},
      {status::kHeadTooLarge, "too_large"},
      {status::kFailed, "failed"},
      {status::kUnavailable, "unavailable"},
      {status::kNoAnswer, "no_answer"},
  }};
  const auto* const found =
      std::find_if(kWords.begin(), kWords.end(), [code](const auto& word) { return word.first == code; });
  return found != kWords.end() ? found->second : "failed";
}

Reply json_reply(const base::Json& value) {
  Reply reply;
  reply.body = value.dump() + "\n";
  return reply;
}

Reply refusal(int code, std::string message, const std::vector<std::string>& details) {
  base::Json body = base::Json::object();
  body["error"] = word_of(code);
  body["message"] = std::move(message);
  if (!details.empty()) {
    body["details"] = details;
  }
  Reply reply = json_reply(body);
  reply.status = code;
  return reply;
}

std::optional<std::string> query_value(const Request& request, std::string_view name) {
  const auto found =
      std::find_if(request.query.begin(), request.query.end(), [name](const auto& pair) { return pair.first == name; });
  return found != request.query.end() ? std::optional(found->second) : std::nullopt;
}

}  // namespace indurop::serve
