// SPDX-License-Identifier: Apache-2.0
// What holds for every verb of `indurop`.

#include <gmock/gmock.h>

#include <algorithm>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "core/base/options.h"
#include "tools/cli/command/verb.h"

namespace indurop::tools {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

// A verb as the program makes it, ready to parse.
struct Declared {
  explicit Declared(const Verb& verb) : options(std::string("indurop ") + verb.name, verb.summary) {
    action = verb.declare(options, context);
  }
  std::vector<base::OptionText> all() const {
    const base::CommandText text = options.text();
    std::vector<base::OptionText> found = text.options;
    for (const base::CommandText& command : text.commands) {
      found.insert(found.end(), command.options.begin(), command.options.end());
    }
    return found;
  }
  Context context;
  base::Options options;
  Action action;
};

class EveryVerb : public ::testing::TestWithParam<const Verb*> {};
std::vector<const Verb*> verbs() {
  std::vector<const Verb*> all;
  for (const Verb& verb : all_verbs()) {
    all.push_back(&verb);
  }
  return all;
}
INSTANTIATE_TEST_SUITE_P(Tools, EveryVerb, ::testing::ValuesIn(verbs()),
                         [](const auto& test) { return std::string(test.param->name); });

// Words of a line as a shell would take them, up to a pipe, a redirection or a comment.
std::vector<std::string> words_of(const std::string& line) {
  std::vector<std::string> words(1);
  char quote = '\0';
  for (const char c : line) {
    if (quote != '\0') {
      if (c == quote) {
        quote = '\0';
      } else {
        words.back() += c;
      }
    } else if (c == '\'' || c == '"') {
      quote = c;
    } else if (c == ' ') {
      words.emplace_back();
    } else {
      words.back() += c;
    }
  }
  std::erase(words, "");
  const auto ends = [](const std::string& word) { return word == "|" || word == ">" || word == "&" || word[0] == '#'; };
  words.erase(std::find_if(words.begin(), words.end(), ends), words.end());
  return words;
}

// The help of a verb and of all its commands.
std::vector<std::string> helps_of(const Verb& verb) {
  std::vector<std::vector<std::string>> all{{"--help"}};
  for (const base::CommandText& command : Declared(verb).options.text().commands) {
    all.push_back({command.name, "--help"});
  }
  std::vector<std::string> helps;
  for (const std::vector<std::string>& words : all) {
    const auto result = Declared(verb).options.parse(words);
    EXPECT_EQ(result.outcome, base::Options::Outcome::Info);
    helps.push_back(result.text);
  }
  return helps;
}

TEST_P(EveryVerb, Has_a_help_whose_lines_end_before_column_100) {
  for (const std::string& help : helps_of(*GetParam())) {
    std::istringstream lines(help);
    for (std::string line; std::getline(lines, line);) {
      EXPECT_LT(line.size(), 100U) << line;
    }
  }
}

TEST_P(EveryVerb, Has_a_summary_that_fits_into_the_list_of_verbs) {
  constexpr std::size_t kColumn = 13;
  EXPECT_LT(std::string(GetParam()->summary).size() + kColumn, 100U);
}

TEST_P(EveryVerb, Has_examples_that_it_understands) {
  const Verb& verb = *GetParam();
  const std::string start = std::string("  indurop ") + verb.name;
  std::istringstream lines(verb.details);
  int examples = 0;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(start + " ") && line != start) {
      continue;
    }
    ++examples;
    std::vector<std::string> words = words_of(line);
    words.erase(words.begin(), words.begin() + 2);
    Declared sut(verb);
    const auto result = sut.options.parse(words);
    // The keys and the report of an example are not here: it is understood, and looks for them.
    const bool missing = result.text.find("--keys: there are no keys in keys:") != std::string::npos ||
                         result.text.find("--times: cannot read report.json") != std::string::npos;
    if (!missing) {
      EXPECT_EQ(result.outcome, base::Options::Outcome::Parsed) << line << ": " << result.text;
    }
  }
  EXPECT_GT(examples, 0);
}

TEST_P(EveryVerb, Refuses_an_option_that_it_does_not_have) {
  Declared sut(*GetParam());
  const auto result = sut.options.parse({"--no-such-option"});
  EXPECT_EQ(result.outcome, base::Options::Outcome::Wrong);
  EXPECT_THAT(result.text, StartsWith("there is no option --no-such-option"));
}

TEST_P(EveryVerb, Calls_the_same_thing_by_the_same_name) {
  const std::vector<std::pair<std::string, std::string>> known{
      {"--node", "NAME"},    {"--timeout", "TIME"}, {"--interval", "TIME"}, {"--wait", "TIME"},  {"--count", "COUNT"},
      {"--interface", "IF"}, {"--domain", "N"},     {"--keys", "DIR"},      {"--health", "TIME"}};
  Declared sut(*GetParam());
  for (const base::OptionText& option : sut.all()) {
    EXPECT_FALSE(option.help.empty()) << option.long_name;
    EXPECT_FALSE(option.help.ends_with('.') && !option.help.ends_with("..."))
        << option.long_name << ": " << option.help;
    for (const auto& [name, value] : known) {
      EXPECT_TRUE(option.long_name != name || option.value == value) << name << " " << option.value;
    }
  }
}

TEST_P(EveryVerb, Offers_its_forms_by_name_and_refuses_others) {
  const auto has_forms = [](const Declared& of) {
    const auto all = of.all();
    return std::any_of(all.begin(), all.end(), [](const auto& option) { return option.long_name == "--output"; });
  };
  Declared sut(*GetParam());
  if (!has_forms(sut) || !sut.options.text().commands.empty()) {
    return;
  }
  const auto result = sut.options.parse({"-o", "picture"});
  EXPECT_EQ(result.outcome, base::Options::Outcome::Wrong);
  EXPECT_THAT(result.text, HasSubstr("--output: 'picture' is not one of "));
}

TEST(Verbs, Have_names_of_their_own) {
  std::set<std::string> names;
  for (const Verb& verb : all_verbs()) {
    EXPECT_TRUE(names.insert(verb.name).second) << verb.name;
    EXPECT_FALSE(std::string(verb.summary).ends_with('.')) << verb.name;
  }
}

}  // namespace
}  // namespace indurop::tools
