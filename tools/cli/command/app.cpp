// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/command/app.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "core/base/option_pages.h"
#include "tools/cli/command/verb.h"
#include "tools/client/process/interrupt.h"
#include "tools/client/text/suggest.h"

namespace indurop::tools {
namespace {

constexpr const char* kPurpose = "check, run and inspect InduRoP nodes";
constexpr const char* kDescription =
    "A node runs the modules of a module.xml on one board, each with its own period, and holds the variables that\n"
    "they share. indurop checks configurations before they run, starts and stops nodes, and shows and changes\n"
    "what a running node does. It reads the node's shared memory directly, so observing a node does not disturb\n"
    "it. A TIME is in seconds (2, 0.5) or has a unit: 500ms, 2s, 1min.\n"
    "\n"
    "Environment:\n"
    "  INDUROP_NODE       Node to use\n"
    "  INDUROP_STATE_DIR  Folder of retained values; default /var/lib/indurop for root, else ~/.local/state/indurop\n"
    "  NO_COLOR           If set, the output has no color\n"
    "Files:\n"
    "  /dev/shm/indurop.NAME  Shared variables of node NAME; with .run its statistics, with .lock its name's lock\n";

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
  std::string text =
      fmt::format("indurop - {}\n\n", kPurpose) + output.paint(Style::Bold, "Usage:") + " indurop VERB [options]\n";
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
          "  -q, --quiet                   Only errors\n"
          "  --color auto|always|never     Colour (default auto: on terminals, unless NO_COLOR is set)\n"
          "  --version                     Version of the program\n"
          "\n" +
          output.paint(Style::Bold, "Exit codes:") +
          "\n"
          "\n";
  for (const ExitCode& code : kExitCodes) {
    text += fmt::format("  {:<4} {}\n", code.value, code.text);
  }
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

// `indurop --node a status` is the same as `indurop status --node a`. Returns the index of the verb.
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

void add_common_options(base::Options& app, ColorWhen& color, bool& quiet) {
  app.flag("-q,--quiet", quiet, "Only errors");
  const auto take = [&color](const std::string& when) {
    color = when == "auto" ? ColorWhen::Auto : when == "always" ? ColorWhen::Always : ColorWhen::Never;
    return std::string();
  };
  app.add("--color", "WHEN", take, "Colour: auto|always|never").choices({"auto", "always", "never"});
  app.version(fmt::format("indurop {}", INDUROP_VERSION));
}

// A program that reads JSON gets an object, also for a failure before anything was printed.
void print_failure(Context& context, int code) {
  const auto* const known =
      std::find_if(kExitCodes.begin(), kExitCodes.end(), [code](const ExitCode& each) { return each.value == code; });
  JsonValue whole = document();
  whole["error"] = {{"exit_code", code},
                    {"name", known == kExitCodes.end() ? JsonValue() : JsonValue(std::string(known->name))},
                    {"messages", context.out.errors()}};
  context.out.line(whole.dump());
}

int finish(Context& context, int code) {
  if (code != kOk && context.format == Format::Json && !context.out.written()) {
    print_failure(context, code);
  }
  if (!context.out.flush() && !context.out.reader_gone()) {
    context.out.error(fmt::format("cannot write the output: {}", std::strerror(context.out.write_errno())));
    return code == kOk ? kFailed : code;
  }
  return interrupted() ? interrupt_code() : code;
}

// A verb with all its options; the values that they set live as long as this.
struct Declared {
  Declared(const Verb& verb, Context& context)
      : options(std::string("indurop ") + verb.name, verb.summary), action(verb.declare(options, context)) {
    options.details(verb.details);
    add_common_options(options, color, quiet);
  }
  base::Options options;
  ColorWhen color = ColorWhen::Auto;
  bool quiet = false;
  Action action;
};

int run_verb(Context& context, const Verb& verb, std::vector<std::string> arguments) {
  Declared declared(verb, context);
  const base::Options::Result parsed = declared.options.parse(std::move(arguments));
  switch (parsed.outcome) {
    case base::Options::Outcome::Info:
      context.out.write(parsed.text);
      return finish(context, kOk);
    case base::Options::Outcome::Wrong:
      context.out.error(fmt::format("{} (see: indurop help {})", parsed.text, verb.name));
      return finish(context, kUsage);
    case base::Options::Outcome::Parsed:
      break;
  }
  context.out.configure(declared.color, declared.quiet);
  return finish(context, declared.action(context));
}

// Returns the description of the whole program, for man pages and completion.
base::CommandText program_text() {
  base::Options line("indurop", kPurpose);
  line.version(INDUROP_VERSION);
  line.details(kDescription);
  base::CommandText program = line.text();
  std::vector<std::string> names;
  for (const Verb& verb : all_verbs()) {
    Context context;
    base::CommandText text = Declared(verb, context).options.text();
    text.name = verb.name;
    text.group = verb.group;
    program.commands.push_back(std::move(text));
    names.emplace_back(verb.name);
  }
  std::string word;
  base::Options help("help", "List the verbs, or explain one of them");
  help.add("verb", "VERB", word, "Verb to explain").choices(names);
  program.commands.push_back(help.text());
  program.commands.back().group = "Help";
  return program;
}

// Prints the page of --help-format FORM, which packages install.
int print_page(Context& context, const std::string& form) {
  const auto page = base::page_of(program_text(), form);
  if (!page) {
    context.out.error(fmt::format("there is no format '{}': man, markdown, bash, zsh, fish", form));
    return kUsage;
  }
  context.out.write(*page);
  return finish(context, kOk);
}

}  // namespace

int run_program(std::vector<std::string> arguments) {
  Context context;
  if (arguments.size() == 2 && arguments[0] == "--help-format") {
    return print_page(context, arguments[1]);
  }
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
  return run_verb(context, *verb, std::move(arguments));
}

}  // namespace indurop::tools
