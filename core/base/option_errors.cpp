// SPDX-License-Identifier: Apache-2.0
#include "core/base/option_errors.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <vector>

#include "core/base/nearest.h"

namespace indurop::base {
namespace {

// Collects the options of the command itself and of those of its commands that were named.
void options_of(const CommandText& command, const CLI::App& app, std::vector<OptionText>& all) {
  all.insert(all.end(), command.options.begin(), command.options.end());
  for (const CLI::App* chosen : app.get_subcommands()) {
    const auto text = std::find_if(command.commands.begin(), command.commands.end(),
                                   [&](const CommandText& one) { return one.name == chosen->get_name(); });
    if (text != command.commands.end()) {
      options_of(*text, *chosen, all);
    }
  }
}

std::string hint(const std::string& word, const std::vector<std::string>& known) {
  const std::string near = nearest(word, known);
  return near.empty() ? "" : fmt::format("; did you mean {}?", near);
}

std::string unknown_option(const std::string& word, const std::vector<OptionText>& options) {
  const std::string name = word.substr(0, word.find('='));
  std::vector<std::string> known;
  for (const OptionText& option : options) {
    if (!option.positional) {
      known.push_back(option.long_name);
    }
  }
  return fmt::format("there is no option {}{}", name, hint(name, known));
}

std::string too_many(const std::vector<std::string>& words, const std::vector<OptionText>& options) {
  const auto first =
      std::find_if(words.begin(), words.end(), [](const std::string& word) { return word.starts_with('-'); });
  if (first != words.end()) {
    return unknown_option(*first, options);
  }
  const bool takes_some =
      std::any_of(options.begin(), options.end(), [](const OptionText& option) { return option.positional; });
  return fmt::format("'{}' {} {}", fmt::join(words, "', '"), words.size() == 1 ? "is" : "are",
                     takes_some ? "too much" : "not expected here");
}

std::string bare_name(const std::string& name) {
  return name.substr(std::min(name.find_first_not_of(std::string{'-', kArgumentMark}), name.size()));
}

// Returns the option named in a message. CLI11 begins its message with the option's name, for flags without dashes.
const OptionText* named_in(const std::string& message, const std::vector<OptionText>& options) {
  const std::string name = bare_name(message.substr(0, message.find_first_of(": ")));
  const auto found = std::find_if(options.begin(), options.end(), [&](const OptionText& option) {
    return bare_name(option.long_name) == name || bare_name(option.short_name) == name;
  });
  return found == options.end() ? nullptr : &*found;
}

std::string missing(const OptionText& option) {
  return option.positional ? fmt::format("{} is missing", option.value)
                           : fmt::format("{} {} is missing", option.long_name, option.value);
}

std::string missing_command(const std::vector<std::string>& extra, const CommandText& command) {
  if (extra.empty()) {
    return "a command is missing";
  }
  std::vector<std::string> known;
  for (const CommandText& one : command.commands) {
    known.push_back(one.name);
  }
  return fmt::format("there is no command '{}'{}", extra.front(), hint(extra.front(), known));
}

}  // namespace

std::string wrong_words(const CLI::ParseError& error, const CLI::App& app, const CommandText& command) {
  std::vector<OptionText> options;
  options_of(command, app, options);
  std::vector<std::string> extra = app.remaining(true);
  std::erase(extra, "--");  // after an error the parser leaves it like a word
  const bool strange = std::any_of(extra.begin(), extra.end(), [](const auto& word) { return word.starts_with('-'); });
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr || strange) {
    return too_many(extra, options);
  }
  const OptionText* const option = named_in(error.what(), options);
  if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr) {
    return option != nullptr ? missing(*option) : missing_command(extra, command);
  }
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr && option != nullptr) {
    return option->value.empty() ? fmt::format("{} takes no value", option->long_name)
                                 : fmt::format("{}: {} is missing", option->long_name, option->value);
  }
  return error.what();
}

}  // namespace indurop::base
