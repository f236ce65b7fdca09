// SPDX-License-Identifier: Apache-2.0
#include "core/base/options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdio>

#include "core/base/exit_code.h"
#include "core/base/help_text.h"
#include "core/base/option_errors.h"
#include "core/base/option_pages.h"
#include "core/base/standard_files.h"

namespace indurop::base {

struct Option::State {
  OptionText text;
  std::vector<Take> checks;
  Take take;
};

namespace {

constexpr const char* kFormatFlag = "--help-format";
constexpr const char* kHelpHelp = "Print help and exit";
constexpr const char* kVersionHelp = "Print the version and exit";

// CLI11 mistakes "-2" for an option and splits "[1,2]" into two: such words are marked before it sees them.
constexpr char kMark = '\x01';

std::vector<std::string> marked(std::vector<std::string> words) {
  for (std::string& word : words) {
    const bool negative =
        word == "-inf" || (word.size() > 1 && word[0] == '-' &&
                           (std::isdigit(static_cast<unsigned char>(word[1])) != 0 || word[1] == '.'));
    if (negative || (!word.empty() && word[0] == '[')) {
      word.insert(word.begin(), kMark);
    }
  }
  return words;
}

std::string unmarked(std::string text) {
  std::erase(text, kMark);
  return text;
}

template <class T>
bool read_number(const std::string& text, T& to) {
  T value{};
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = code == std::errc() && end == text.data() + text.size();
  to = whole ? value : to;
  return whole;
}

Completion usual_completion(const std::string& value) {
  if (value.starts_with("FILE") || value.starts_with("LIST") || value == "PLANT") {
    return Completion::File;
  }
  return value == "DIR" ? Completion::Folder : Completion::None;
}

class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_option_name(const CLI::Option* option, bool positional) const override {
    const std::string name = CLI::Formatter::make_option_name(option, positional);
    return name.starts_with(kArgumentMark) ? name.substr(1) : name;
  }
};

OptionText text_of(const std::string& names, const std::string& value, const std::string& help) {
  OptionText text;
  const auto comma = names.find(',');
  text.short_name = comma == std::string::npos ? "" : names.substr(0, comma);
  text.long_name = comma == std::string::npos ? names : names.substr(comma + 1);
  text.value = value;
  text.help = help;
  text.positional = !names.starts_with('-');
  text.completion = usual_completion(value);
  return text;
}

}  // namespace

Option& Option::required() {
  state_->text.required = true;
  option_->required();
  return *this;
}

Option& Option::range(double least, double most) {
  return check([least, most](const std::string& text) {
    double value = 0;
    const bool outside = read_number(text, value) && !(least <= value && value <= most);
    return outside ? fmt::format("{} is not in the range {} to {}", text, least, most) : std::string();
  });
}

Option& Option::choices(std::vector<std::string> all) {
  state_->text.choices = all;
  return check([all = std::move(all)](const std::string& text) {
    if (std::find(all.begin(), all.end(), text) != all.end()) {
      return std::string();
    }
    return fmt::format("'{}' is not one of {}", text, fmt::join(all, "|"));
  });
}

Option& Option::check(Take rule) {
  state_->checks.push_back(std::move(rule));
  return *this;
}

Option& Option::needs(const Option& other) {
  option_->needs(other.option_);
  return *this;
}

Option& Option::implies(bool& flag) {
  return check([&flag](const std::string& /*text*/) {
    flag = true;
    return std::string();
  });
}

Option& Option::one_at_a_time() {
  option_->allow_extra_args(false);
  option_->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  return *this;
}

Option& Option::completes(Completion what) {
  state_->text.completion = what;
  return *this;
}

Options::Options(const std::string& name, std::string purpose)
    : owned_(std::make_unique<CLI::App>(purpose, name)), app_(owned_.get()) {
  open_standard_files();  // every program begins here
  text_.name = name;
  text_.purpose = std::move(purpose);
  app_->formatter(std::make_shared<HelpFormatter>());
  app_->get_formatter()->column_width(kHelpDescription);
  app_->get_formatter()->label("Positionals", "Arguments");
  app_->get_formatter()->label("Needs", "needs");
  app_->get_formatter()->label("REQUIRED", "(required)");
  app_->set_help_flag("-h,--help", kHelpHelp);
  app_->option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
}

Options::Options(CLI::App& app, std::string name, std::string purpose) : app_(&app) {
  text_.name = std::move(name);
  text_.purpose = std::move(purpose);
}

Options::~Options() = default;

Option Options::make(const std::string& names, const std::string& value, Take take, const std::string& help) {
  options_.push_back(std::make_unique<Option::State>());
  Option::State& state = *options_.back();
  state.text = text_of(names, value, help);
  state.take = std::move(take);
  const auto take_all = [&state](const CLI::results_t& results) {
    for (const std::string& result : results) {
      const std::string text = unmarked(result);
      std::string wrong;
      for (auto rule = state.checks.begin(); wrong.empty() && rule != state.checks.end(); ++rule) {
        wrong = (*rule)(text);
      }
      wrong = wrong.empty() ? state.take(text) : wrong;
      if (!wrong.empty()) {
        throw CLI::ValidationError(state.text.long_name, wrong);
      }
    }
    return true;
  };
  CLI::Option* made = app_->add_option(state.text.positional ? kArgumentMark + names : names, take_all, help);
  made->type_name(value);
  return {state, *made};
}

Option Options::flag(const std::string& names, bool& to, const std::string& help) {
  options_.push_back(std::make_unique<Option::State>());
  Option::State& state = *options_.back();
  state.text = text_of(names, "", help);
  const auto given = [&state, &to](std::int64_t count) {
    to = count > 0;
    for (const Take& rule : state.checks) {
      static_cast<void>(rule(""));
    }
  };
  CLI::Option* made = app_->add_flag_function(names, given, help);
  made->disable_flag_override();
  return {state, *made};
}

Option Options::add(const std::string& names, const std::string& value, Take take, const std::string& help) {
  return make(names, value, std::move(take), help);
}

Option Options::add(const std::string& names, const std::string& value, std::string& to, const std::string& help) {
  return make(
      names, value,
      [&to](const std::string& text) {
        to = text;
        return std::string();
      },
      help);
}

Option Options::add(const std::string& names, const std::string& value, int& to, const std::string& help) {
  return make(
      names, value,
      [&to](const std::string& text) {
        return read_number(text, to) ? std::string() : fmt::format("'{}' is not a whole number", text);
      },
      help);
}

Option Options::add(const std::string& names, const std::string& value, std::uint64_t& to, const std::string& help) {
  return make(
      names, value,
      [&to](const std::string& text) {
        return read_number(text, to) ? std::string() : fmt::format("'{}' is not a whole number from 0 on", text);
      },
      help);
}

Option Options::add(const std::string& names, const std::string& value, double& to, const std::string& help) {
  return make(
      names, value,
      [&to](const std::string& text) {
        return read_number(text, to) ? std::string() : fmt::format("'{}' is not a number", text);
      },
      help);
}

Option Options::add(const std::string& names, const std::string& value, std::optional<int>& to,
                    const std::string& help) {
  return make(
      names, value,
      [&to](const std::string& text) {
        int number = 0;
        const bool good = read_number(text, number);
        to = good ? std::optional(number) : to;
        return good ? std::string() : fmt::format("'{}' is not a whole number", text);
      },
      help);
}

Option Options::add(const std::string& names, const std::string& value, std::vector<std::string>& to,
                    const std::string& help) {
  const auto take = [&to](const std::string& text) {
    to.push_back(text);
    return std::string();
  };
  Option made = make(names, value, take, help);
  made.option_->expected(CLI::detail::expected_max_vector_size);
  made.state_->text.repeated = true;
  return made;
}

Options& Options::command(const std::string& name, const std::string& purpose, std::function<void()> chosen) {
  app_->require_subcommand(1);
  CLI::App* made = app_->add_subcommand(name, purpose);
  made->callback(std::move(chosen));
  made->fallthrough();
  commands_.push_back(std::unique_ptr<Options>(new Options(*made, name, purpose)));
  return *commands_.back();
}

void Options::usual_command(const std::string& name) {
  usual_ = name;
}

void Options::moved(const std::string& name, const std::string& now) {
  const auto given = [name, now](std::int64_t /*count*/) {
    throw CLI::ValidationError(fmt::format("{} was replaced: use {}", name, now));
  };
  app_->add_flag_function(name, given)->group("");  // without a group it is in no help
}

void Options::details(std::string text) {
  text_.details = std::move(text);
  show_details();
}

void Options::exit_codes(std::vector<int> codes) {
  text_.exit_codes = std::move(codes);
  show_details();
}

void Options::show_details() {
  const std::string gap = text_.details.empty() ? "" : "\n";
  app_->footer(text_.exit_codes.empty() ? text_.details
                                        : text_.details + gap + "Exit codes:\n" + exit_codes_text(text_.exit_codes));
}

void Options::version(const std::string& text) {
  app_->set_version_flag("--version", text, kVersionHelp);
  options_.push_back(std::make_unique<Option::State>());
  options_.back()->text = text_of("--version", "", kVersionHelp);
}

CommandText Options::text() const {
  CommandText all = text_;
  for (const auto& option : options_) {
    all.options.push_back(option->text);
  }
  all.options.push_back(text_of("-h,--help", "", kHelpHelp));
  for (const auto& command : commands_) {
    all.commands.push_back(command->text());
  }
  return all;
}

Options::Result Options::parse(std::vector<std::string> words) {
  const auto names = [this](const std::string& word) {
    return std::any_of(commands_.begin(), commands_.end(), [&](const auto& one) { return one->text_.name == word; });
  };
  const auto asks = [](const std::string& word) { return word == "-h" || word == "--help" || word == "--version"; };
  if (names(usual_) && (words.empty() || words[0].starts_with('-')) &&
      std::none_of(words.begin(), words.end(), names) && std::none_of(words.begin(), words.end(), asks)) {
    words.insert(words.begin(), usual_);
  }
  words = marked(std::move(words));
  std::reverse(words.begin(), words.end());  // CLI11 takes them from the back
  try {
    app_->parse(std::move(words));
  } catch (const CLI::CallForHelp&) {
    return {Outcome::Info, wrapped_help(app_->help())};
  } catch (const CLI::CallForVersion&) {
    return {Outcome::Info, app_->version() + "\n"};
  } catch (const CLI::ParseError& error) {
    return {Outcome::Wrong, unmarked(wrong_words(error, *app_, text()))};
  }
  return {};
}

std::optional<int> Options::parse_program(int argc, char** argv) {
  std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  if (words.size() == 2 && words[0] == kFormatFlag) {
    const auto page = page_of(text(), words[1]);
    std::fputs(page.value_or("").c_str(), page ? stdout : stderr);
    return page ? kOk : kUsage;
  }
  const Result result = parse(std::move(words));
  switch (result.outcome) {
    case Outcome::Parsed:
      return std::nullopt;
    case Outcome::Info:
      std::fputs(result.text.c_str(), stdout);
      return kOk;
    case Outcome::Wrong:
      break;
  }
  std::fputs(fmt::format("{}: error: {}; see {} --help\n", text_.name, result.text, text_.name).c_str(), stderr);
  return kUsage;
}

}  // namespace indurop::base
