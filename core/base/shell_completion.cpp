// SPDX-License-Identifier: Apache-2.0
// Tab completion for bash, zsh and fish, generated from the declared options.

#include <fmt/format.h>

#include <algorithm>

#include "core/base/option_pages.h"

namespace indurop::base {
namespace {

std::string option_words(const CommandText& command) {
  std::string out;
  for (const OptionText& option : command.options) {
    if (!option.positional) {
      out += (option.short_name.empty() ? "" : option.short_name + " ") + option.long_name + " ";
    }
  }
  return out;
}

std::string command_words(const CommandText& command) {
  std::string out;
  for (const CommandText& each : command.commands) {
    out += each.name + " ";
  }
  return out;
}

// Puts text in single quotes of a shell.
std::string quote(const std::string& text) {
  return "'" + replaced(text, "'", "'\\''") + "'";
}

const OptionText* first_positional(const CommandText& command) {
  const auto found = std::find_if(command.options.begin(), command.options.end(),
                                  [](const OptionText& option) { return option.positional; });
  return found == command.options.end() ? nullptr : &*found;
}

constexpr const char* kListNodes = "indurop nodes --names -q 2>/dev/null";
constexpr const char* kListVariables = "indurop vars --names -q 2>/dev/null";
constexpr const char* kListModules = "indurop status -o csv -q 2>/dev/null | sed 1d | cut -d, -f1";

const char* lister(Completion what) {
  switch (what) {
    case Completion::Node:
      return kListNodes;
    case Completion::Variable:
      return kListVariables;
    case Completion::Module:
      return kListModules;
    default:
      return "";
  }
}

// Returns the action of bash for a value; empty: there is none.
std::string bash_action(const OptionText& option, const std::string& function) {
  if (!option.choices.empty()) {
    return fmt::format("{}_words '{}'", function, fmt::join(option.choices, " "));
  }
  switch (option.completion) {
    case Completion::File:
      return "COMPREPLY=($(compgen -f -- \"$cur\"))";
    case Completion::Folder:
      return "COMPREPLY=($(compgen -d -- \"$cur\"))";
    case Completion::None:
      return "";
    default:
      return fmt::format("{}_words \"$({})\"", function, lister(option.completion));
  }
}

std::string function_name(const CommandText& program) {
  return "_" + replaced(program.name, "-", "_");
}

std::string fish_action(const OptionText& option) {
  if (!option.choices.empty()) {
    return fmt::format(" -x -a '{}'", fmt::join(option.choices, " "));
  }
  switch (option.completion) {
    case Completion::File:
      return " -r -F";
    case Completion::Folder:
      return " -x -a '(__fish_complete_directories)'";
    case Completion::None:
      return option.value.empty() ? "" : " -x";
    default:
      return fmt::format(" -x -a '({})'", lister(option.completion));
  }
}

std::string zsh_action(const OptionText& option) {
  if (!option.choices.empty()) {
    return fmt::format("({})", fmt::join(option.choices, " "));
  }
  switch (option.completion) {
    case Completion::File:
      return "_files";
    case Completion::Folder:
      return "_files -/";
    case Completion::None:
      return " ";
    default:
      return fmt::format("{{compadd -- $({})}}", lister(option.completion));
  }
}

// Escapes text inside the brackets of an _arguments specification.
std::string zsh_text(const std::string& text) {
  return replaced(replaced(replaced(replaced(text, "\\", "\\\\"), "[", "\\["), "]", "\\]"), ":", "\\:");
}

std::string zsh_specification(const OptionText& option) {
  const std::string value = option.value.empty() ? "" : ":" + zsh_text(option.value) + ":" + zsh_action(option);
  if (option.positional) {
    return quote((option.repeated ? "*:" : ":") + zsh_text(option.value) + ":" + zsh_action(option));
  }
  std::string out;
  for (const std::string& name : {option.short_name, option.long_name}) {
    if (!name.empty()) {
      out += (out.empty() ? "" : " ") + quote(name + "[" + zsh_text(option.help) + "]" + value);
    }
  }
  return out;
}

}  // namespace

// Long: it contains the script.
std::string bash_completion(const CommandText& program) {
  const std::string function = function_name(program);
  std::string options;
  std::string values;
  std::string words;
  std::string commands;
  each_command(program, "", [&](const std::string& path, const CommandText& command) {
    options += fmt::format("    '{}') {}_words '{}' ;;\n", path, function, option_words(command));
    if (!command.commands.empty()) {
      words += fmt::format("    '{}') {}_words '{}' ;;\n", path, function, command_words(command));
    } else if (const OptionText* first = first_positional(command)) {
      const std::string action = bash_action(*first, function);
      words += action.empty() ? "" : fmt::format("    '{}') {} ;;\n", path, action);
    }
    commands += path.empty() ? "" : fmt::format("      '{}') path=$next ;;\n", path);
    for (const OptionText& option : command.options) {
      if (!option.positional && !option.value.empty()) {
        const std::string names = option.short_name.empty() ? fmt::format("'{}:{}'", path, option.long_name)
                                                            : fmt::format("'{}:{}' | '{}:{}'", path, option.short_name,
                                                                          path, option.long_name);
        const std::string action = bash_action(option, function);
        values += fmt::format("    {}) {}{}return ;;\n", names, action, action.empty() ? "" : "; ");
      }
    }
  });
  return fmt::format(R"(# Tab completion of {0} for bash, made from its options.
{1}_words() {{
  COMPREPLY=($(compgen -W "$1" -- "$cur"))
  # Variable names hold ':', which bash takes for a word break: complete only what follows the last one.
  if declare -F __ltrim_colon_completions >/dev/null; then __ltrim_colon_completions "$cur"; fi
}}
{1}() {{
  local cur prev path='' next word
  if declare -F _get_comp_words_by_ref >/dev/null; then
    _get_comp_words_by_ref -n : cur prev
  else
    cur=${{COMP_WORDS[COMP_CWORD]}}
    prev=${{COMP_WORDS[COMP_CWORD - 1]}}
  fi
  for word in "${{COMP_WORDS[@]:1:COMP_CWORD-1}}"; do
    next=${{path:+$path }}$word
    case $next in
      '') ;;
{2}    esac
  done
  COMPREPLY=()
  case $path:$prev in
    '') ;;
{3}  esac
  if [[ $cur == -* ]]; then
    case $path in
{4}    esac
    return
  fi
  case $path in
    '-') ;;
{5}  esac
}}
complete -F {1} {0}
)",
                     program.name, function, commands, values, options, words);
}

std::string zsh_completion(const CommandText& program) {
  std::string cases;
  each_command(program, "", [&](const std::string& path, const CommandText& command) {
    cases += fmt::format("    {})\n", quote(path));
    if (!command.commands.empty()) {
      cases += "      local -a verbs=(\n";
      for (const CommandText& each : command.commands) {
        cases += "        " + quote(each.name + ":" + zsh_text(each.purpose)) + "\n";
      }
      cases += "      )\n      _describe verb verbs\n";
    }
    cases += "      _arguments";
    for (const OptionText& option : command.options) {
      if (!(option.positional && !command.commands.empty())) {
        cases += " \\\n        " + zsh_specification(option);
      }
    }
    cases += " ;;\n";
  });
  std::string paths;
  each_command(program, "", [&](const std::string& path, const CommandText& /*command*/) {
    paths += path.empty() ? "" : (paths.empty() ? "" : " | ") + quote(path);
  });
  const std::string skip = paths.empty() ? "''" : paths;
  return fmt::format(R"(#compdef {0}
# Tab completion of {0} for zsh, made from its options.
{1}() {{
  local path_='' next_ i_
  for ((i_ = 2; i_ < CURRENT; i_++)); do
    next_=${{path_:+$path_ }}${{words[i_]}}
    case $next_ in
      {2}) path_=$next_; words=("${{words[1]}}" "${{(@)words[i_+1,-1]}}"); ((CURRENT -= i_ - 1)); i_=1 ;;
    esac
  done
  case $path_ in
{3}  esac
}}
{1} "$@"
)",
                     program.name, function_name(program), skip, cases);
}

std::string fish_completion(const CommandText& program) {
  std::string out = fmt::format("# Tab completion of {0} for fish, made from its options.\n", program.name);
  each_command(program, "", [&](const std::string& path, const CommandText& command) {
    const std::string where = path.empty()
                                  ? (command.commands.empty() ? "" : " -n __fish_use_subcommand")
                                  : fmt::format(" -n '__fish_seen_subcommand_from {}'", path.substr(0, path.find(' ')));
    for (const CommandText& each : command.commands) {
      out += fmt::format("complete -c {}{} -f -a {} -d {}\n", program.name, where, each.name, quote(each.purpose));
    }
    for (const OptionText& option : command.options) {
      const std::string names =
          (option.short_name.empty() ? "" : " -s " + option.short_name.substr(1)) +
          (option.positional || option.long_name.empty() ? "" : " -l " + option.long_name.substr(2));
      const std::string action = fish_action(option);
      if (!option.positional || !action.empty()) {
        out += fmt::format("complete -c {}{}{}{} -d {}\n", program.name, where, names, action, quote(option.help));
      }
    }
  });
  return out;
}

}  // namespace indurop::base
