// SPDX-License-Identifier: Apache-2.0
// Man pages and shell completion, generated from the declared options. Pure functions.

#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/base/options.h"

namespace indurop::base {

// Returns the exit codes, one per line; all of them for an empty list.
std::string exit_codes_text(const std::vector<int>& which = {});

std::string man_page(const CommandText& program);  // troff, section 1
std::string markdown_page(const CommandText& program);
std::string bash_completion(const CommandText& program);
std::string zsh_completion(const CommandText& program);
std::string fish_completion(const CommandText& program);

// Calls use(words, command) for a program (no words) and each of its verbs ("plc build").
template <class Use>
void each_command(const CommandText& command, const std::string& words, const Use& use) {
  use(words, command);
  for (const CommandText& each : command.commands) {
    each_command(each, words.empty() ? each.name : words + " " + each.name, use);
  }
}

// Returns `text` with every `what` replaced by `by`.
std::string replaced(std::string text, std::string_view what, std::string_view by);

// `form` is man, markdown, bash, zsh or fish; returns nothing for any other.
std::optional<std::string> page_of(const CommandText& program, std::string_view form);

}  // namespace indurop::base
