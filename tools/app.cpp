// SPDX-License-Identifier: Apache-2.0
#include "tools/app.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <iterator>

#include "tools/interrupt.h"
#include "tools/suggest.h"
#include "tools/verb.h"

namespace indurop::tools {
namespace {

const Verb* find_verb(std::string_view name) {
  if (name == "ps") {
    name = "nodes";
  }
  for (const Verb& verb : all_verbs()) {
    if (name == verb.name) {
      return &verb;
    }
  }
  return nullptr;
}

std::string overview(const Output& output) {
  std::string text = "indurop - look at, check and steer InduRoP nodes\n\n" + output.paint(Style::Bold, "Usage:") +
                     " indurop VERB [options]\n";
  std::string group;
  for (const Verb& verb : all_verbs()) {
    if (group != verb.group) {
      group = verb.group;
      text += "\n" + output.paint(Style::Bold, group + ":") + "\n";
    }
    text += fmt::format("  {:<10} {}\n", verb.name, verb.summary);
  }
  text += "\n" + output.paint(Style::Bold, "Options of every verb:") +
          "\n"
          "  -h, --help                    Help of a verb (also: indurop help VERB)\n"
          "  -q, --quiet                   No messages but errors\n"
          "  --color auto|always|never     Colour (default auto: on terminals, unless NO_COLOR is set)\n"
          "  --version                     Version of the program\n"
          "\n" +
          output.paint(Style::Bold, "Exit codes:") +
          "\n"
          "  0 ok   1 failed   2 wrong usage   3 timing contract broken   4 check found errors\n"
          "  6 node not there or time-out   7 real-time rights not obtained   8 layout differs   130 interrupted\n";
  return text;
}

int unknown_verb(Context& context, const std::string& word) {
  std::vector<std::string> names;
  for (const Verb& verb : all_verbs()) {
    names.emplace_back(verb.name);
  }
  context.out.error(fmt::format("there is no verb '{}'.{} `indurop help` lists all.", word, did_you_mean(word, names)));
  return kUsage;
}

// `indurop --node a status` means `indurop status --node a`. Returns the index of the verb.
std::size_t verb_position(const std::vector<std::string>& arguments) {
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& word = arguments[i];
    if (word == "--node" || word == "-o" || word == "--output" || word == "--color") {
      ++i;
    } else if (word.empty() || word[0] != '-') {
      return i;
    }
  }
  return arguments.size();
}

// CLI11 takes "-2" for an option and splits "[1,2]" into two: a value is marked before and unmarked in the verb.
std::vector<std::string> protect_values(std::vector<std::string> arguments) {
  for (std::string& word : arguments) {
    const bool negative =
        word.size() > 1 && word[0] == '-' && (std::isdigit(static_cast<unsigned char>(word[1])) != 0 || word[1] == '.');
    if (negative || (!word.empty() && word[0] == '[')) {
      word.insert(word.begin(), kValueMark);
    }
  }
  return arguments;
}

void add_common_options(CLI::App& app, ColorWhen& color, bool& quiet) {
  app.add_flag("-q,--quiet", quiet, "No messages but errors");
  app.add_option_function<std::string>(
         "--color",
         [&color](const std::string& when) {
           if (when != "auto" && when != "always" && when != "never") {
             throw CLI::ValidationError("--color", "'" + when + "' is not one of auto|always|never");
           }
           color = when == "auto" ? ColorWhen::Auto : when == "always" ? ColorWhen::Always : ColorWhen::Never;
         },
         "Colour: auto|always|never")
      ->type_name("WHEN");
}

int finish(Context& context, int code) {
  if (!context.out.flush() && !context.out.reader_gone()) {
    context.out.error(fmt::format("cannot write the output: {}", std::strerror(context.out.write_errno())));
    return code == kOk ? kFailed : code;
  }
  return interrupted() ? interrupt_code() : code;
}

int run_verb(Context& context, const Verb& verb, std::vector<std::string> arguments) {
  CLI::App app{verb.summary, std::string("indurop ") + verb.name};
  app.footer(verb.details);
  app.get_formatter()->column_width(30);
  app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  ColorWhen color = ColorWhen::Auto;
  bool quiet = false;
  const Action action = verb.declare(app, context);
  add_common_options(app, color, quiet);
  try {
    arguments = protect_values(std::move(arguments));
    std::reverse(arguments.begin(), arguments.end());  // CLI11 takes them from the back
    app.parse(std::move(arguments));
  } catch (const CLI::CallForHelp&) {
    context.out.write(app.help());
    return finish(context, kOk);
  } catch (const CLI::ParseError& error) {
    std::string text = error.what();
    text.erase(std::remove(text.begin(), text.end(), kValueMark), text.end());
    context.out.error(fmt::format("{} (see: indurop help {})", text, verb.name));
    return kUsage;
  }
  context.out.configure(color, quiet);
  return finish(context, action(context));
}

}  // namespace

int run_program(std::vector<std::string> arguments) {
  Context context;
  const std::size_t at = verb_position(arguments);
  if (at == arguments.size()) {
    const auto given = [&arguments](const char* word) {
      return std::find(arguments.begin(), arguments.end(), word) != arguments.end();
    };
    if (given("--version")) {
      context.out.line(fmt::format("indurop {}", INDUROP_VERSION));
      return finish(context, kOk);
    }
    if (given("-h") || given("--help")) {
      context.out.write(overview(context.out));
      return finish(context, kOk);
    }
    context.out.error("which verb? `indurop help` lists all");
    return kUsage;
  }
  std::string word = arguments[at];
  arguments.erase(arguments.begin() + static_cast<std::ptrdiff_t>(at));
  if (word == "help") {
    if (arguments.empty()) {
      context.out.write(overview(context.out));
      return finish(context, kOk);
    }
    word = arguments.front();
    arguments = {"--help"};
  }
  const Verb* verb = find_verb(word);
  if (verb == nullptr) {
    return unknown_verb(context, word);
  }
  if (verb->pass_through != nullptr) {
    return finish(context, verb->pass_through(context, arguments));
  }
  return run_verb(context, *verb, std::move(arguments));
}

}  // namespace indurop::tools
