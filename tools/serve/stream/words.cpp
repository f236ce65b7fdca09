// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/stream/words.h"

#include <fmt/format.h>

namespace indurop::serve {
namespace {

// Returns what is wrong with the members of a subscription, else an empty text.
std::string read_subscription(const base::Json& json, ClientWord& word) {
  if (!base::read_if_given(json, "board", word.board)) {
    return "board is a name";
  }
  if (!base::read(json, "names", word.names) || word.names.empty() || word.names.size() > kMostNames) {
    return fmt::format("names is a list of 1 to {} names or globs", kMostNames);
  }
  if (!base::read_if_given(json, "binary", word.binary)) {
    return "binary is true or false";
  }
  if (const base::Json* const rate = json.find("rate_hz")) {
    word.rate_hz = rate->number().value_or(0);
    if (!(word.rate_hz >= kLeastRateHz && word.rate_hz <= kHighestRateHz)) {
      return fmt::format("rate_hz is a number of {} to {}", kLeastRateHz, kHighestRateHz);
    }
  }
  return {};
}

}  // namespace

Result<ClientWord, WordProblem> read_word(std::string_view text) {
  const auto json = base::Json::parse(text);
  if (!json || !json->is_object()) {
    return WordProblem{true, std::nullopt, "that is no JSON object"};
  }
  std::uint64_t id = 0;
  if (!base::read(*json, "id", id) || id > UINT32_MAX) {
    return WordProblem{false, std::nullopt, "id is a number of 0 to 4294967295"};
  }
  ClientWord word;
  word.id = static_cast<std::uint32_t>(id);
  std::string type;
  base::read(*json, "type", type);
  if (type == "unsubscribe") {
    word.kind = ClientWord::Kind::Unsubscribe;
    return word;
  }
  if (type != "subscribe") {
    return WordProblem{false, word.id, "type is subscribe or unsubscribe"};
  }
  if (std::string problem = read_subscription(*json, word); !problem.empty()) {
    return WordProblem{false, word.id, std::move(problem)};
  }
  return word;
}

base::Json error_word(std::optional<std::uint32_t> id, std::string_view error, const std::string& message) {
  base::Json out = base::Json::object();
  out["type"] = "error";
  out["id"] = id ? base::Json(*id) : base::Json();
  out["error"] = error;
  out["message"] = message;
  return out;
}

}  // namespace indurop::serve
