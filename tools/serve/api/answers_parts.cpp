// SPDX-License-Identifier: Apache-2.0
// Functions that several answers share.
#include <fmt/format.h>

#include <charconv>

#include "core/base/text.h"
#include "tools/serve/api/answers.h"
#include "tools/serve/boards/boards.h"

namespace indurop::serve {

Result<Board*, Reply> board_of(const Call& call) {
  const std::string& name = call.part.find("board")->second;
  Board* const board = call.boards->find(name);
  if (board == nullptr) {
    return refusal(status::kNotFound,
                   fmt::format("there is no board '{}'{}", name, base::suggestion(name, call.boards->names())));
  }
  return board;
}

base::Json about(const Board& board) {
  base::Json out = base::Json::object();
  out["board"] = board.name();
  return out;
}

std::optional<std::uint64_t> query_number(const Call& call, std::string_view name, std::uint64_t usual,
                                          std::uint64_t least, std::uint64_t most) {
  const auto text = query_value(*call.request, name);
  if (!text) {
    return usual;
  }
  std::uint64_t number = 0;
  const auto parsed = std::from_chars(text->data(), text->data() + text->size(), number);
  const bool whole = parsed.ec == std::errc() && parsed.ptr == text->data() + text->size();
  return whole && number >= least && number <= most ? std::optional(number) : std::nullopt;
}

}  // namespace indurop::serve
