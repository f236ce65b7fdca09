// SPDX-License-Identifier: Apache-2.0
#include "deploy/words/command_words.h"

#include <fmt/format.h>

#include <algorithm>

namespace indurop::deploy {

namespace {

constexpr std::string_view kUserMark = "user\n";

}  // namespace

std::string user_signature_text(const UserSignature& signature) {
  return fmt::format("{}{}\n{}", kUserMark, signature.signature, signature.certificate);
}

std::optional<UserSignature> read_user_signature(std::string_view text) {
  if (!text.starts_with(kUserMark)) {
    return std::nullopt;
  }
  text.remove_prefix(kUserMark.size());
  const std::size_t end = std::min(text.find('\n'), text.size());
  return UserSignature{std::string(text.substr(0, end)), std::string(text.substr(std::min(end + 1, text.size())))};
}

std::string command_text(const Command& command) {
  return fmt::format("indurop command\n{}\n{}\n{}\n{}\n{}\n{}\n{}\n", command.plant, command.board, command.agent,
                     static_cast<int>(command.action), command.target, command.commander, command.nonce);
}

}  // namespace indurop::deploy
