// SPDX-License-Identifier: Apache-2.0
#include "core/base/option_pages.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/exit_code.h"

namespace indurop::base {
namespace {

bool has_details(const CommandText& command) {
  return command.details.find_first_not_of(" \n") != std::string::npos;
}

// Returns "-o, --output FORM", `around` and `value` being put before literals and placeholders.
std::string heading(const OptionText& option, std::string_view around, std::string_view after, std::string_view value) {
  std::string out;
  for (const std::string& name : {option.short_name, option.positional ? std::string() : option.long_name}) {
    if (!name.empty()) {
      out += fmt::format("{}{}{}{}", out.empty() ? "" : ", ", around, name, after);
    }
  }
  if (!option.value.empty()) {
    out += fmt::format("{}{}{}{}{}", out.empty() ? "" : " ", value, option.value, after,
                       option.positional && option.repeated ? "..." : "");
  }
  return out;
}

std::vector<ExitCode> exit_codes(const std::vector<int>& which) {
  std::vector<ExitCode> out;
  for (const ExitCode& code : kExitCodes) {
    if (which.empty() || std::find(which.begin(), which.end(), code.value) != which.end()) {
      out.push_back(code);
    }
  }
  return out;
}

// ---- man

// Escapes text for troff.
std::string roff(std::string text) {
  text = replaced(replaced(std::move(text), "\\", "\\e"), "-", "\\-");
  text = replaced(replaced(std::move(text), "'", "\\(aq"), "`", "\\(ga");
  text = replaced(replaced(std::move(text), "^", "\\(ha"), "~", "\\(ti");
  if (text.starts_with('.')) {
    text.insert(0, "\\&");
  }
  return replaced(std::move(text), "\n.", "\n\\&.");
}

// Formats the paragraphs of `text` unchanged, line by line: they contain examples and lists.
std::string roff_lines(const std::string& text) {
  const auto begin = text.find_first_not_of('\n');
  const auto end = text.find_last_not_of(" \n");
  if (begin == std::string::npos || end == std::string::npos) {
    return {};
  }
  return ".PP\n.nf\n" + roff(text.substr(begin, end - begin + 1)) + "\n.fi\n";
}

std::string synopsis(const CommandText& command) {
  std::string out = "\\fB" + roff(command.name) + "\\fR";
  if (!command.commands.empty()) {
    return out + " \\fIVERB\\fR [\\fIoptions\\fR]";
  }
  out += command.options.empty() ? "" : " [\\fIoptions\\fR]";
  for (const OptionText& option : command.options) {
    if (option.positional) {
      const std::string word = "\\fI" + roff(option.value) + "\\fR" + (option.repeated ? "..." : "");
      out += option.required ? " " + word : " [" + word + "]";
    }
  }
  return out;
}

std::string man_options(const CommandText& command) {
  std::string out;
  for (const OptionText& option : command.options) {
    out += ".TP\n" + replaced(heading(option, "\\fB", "\\fR", "\\fI"), "-", "\\-") + "\n" + roff(option.help) + ".\n";
  }
  return out;
}

// Describes a verb below ".SS verb"; its own verbs follow.
std::string man_command(const CommandText& command, const std::string& before) {
  CommandText named = command;
  named.name = before + command.name;
  std::string out = fmt::format(".SS {}\n{}\n.PP\n{}.\n", roff(named.name), synopsis(named), roff(command.purpose));
  out += man_options(command) + roff_lines(command.details);
  for (const CommandText& each : command.commands) {
    out += man_command(each, named.name + " ");
  }
  return out;
}

}  // namespace

std::string replaced(std::string text, std::string_view what, std::string_view by) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size())) {
    text.replace(at, what.size(), by);
  }
  return text;
}

std::string exit_codes_text(const std::vector<int>& which) {
  std::string out;
  for (const ExitCode& code : exit_codes(which)) {
    out += fmt::format("  {:<4} {}\n", code.value, code.text);
  }
  return out;
}

std::string man_page(const CommandText& program) {
  std::string title = program.name;
  std::transform(title.begin(), title.end(), title.begin(), [](unsigned char c) { return std::toupper(c); });
  std::string out = fmt::format(".TH {} 1 \"\" \"InduRoP\" \"User Commands\"\n", roff(title));
  out += fmt::format(".SH NAME\n{} \\- {}\n", roff(program.name), roff(program.purpose));
  out += fmt::format(".SH SYNOPSIS\n{}\n", synopsis(program));
  if (has_details(program)) {
    out += ".SH DESCRIPTION\n" + roff_lines(program.details);
  }
  std::string group;
  for (const CommandText& each : program.commands) {
    if (group != each.group) {
      group = each.group;
      std::string upper = group;
      std::transform(upper.begin(), upper.end(), upper.begin(), [](unsigned char c) { return std::toupper(c); });
      out += fmt::format(".SH {}\n", roff(upper));
    }
    out += man_command(each, "");
  }
  out += program.options.empty() ? "" : ".SH OPTIONS\n" + man_options(program);
  out += ".SH EXIT STATUS\n";
  for (const ExitCode& code : exit_codes(program.exit_codes)) {
    out += fmt::format(".TP\n{}\n{}\n", code.value, roff(std::string(code.text)));
  }
  return out;
}

std::string markdown_page(const CommandText& program) {
  std::string out;
  each_command(program, "", [&](const std::string& words, const CommandText& command) {
    const std::string name = words.empty() ? program.name : program.name + " " + words;
    out += fmt::format("## {}\n\n{}.\n\n", name, command.purpose);
    for (const OptionText& option : command.options) {
      out += fmt::format("- `{}`: {}\n", heading(option, "", "", ""), option.help);
    }
    out += has_details(command)
               ? "\n```\n" + command.details + (command.details.ends_with('\n') ? "" : "\n") + "```\n\n"
               : "\n";
  });
  return out;
}

std::optional<std::string> page_of(const CommandText& program, std::string_view form) {
  if (form == "man") {
    return man_page(program);
  }
  if (form == "markdown") {
    return markdown_page(program);
  }
  if (form == "bash") {
    return bash_completion(program);
  }
  if (form == "zsh") {
    return zsh_completion(program);
  }
  if (form == "fish") {
    return fish_completion(program);
  }
  return std::nullopt;
}

}  // namespace indurop::base
