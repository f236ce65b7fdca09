// SPDX-License-Identifier: Apache-2.0
// Options declared once: how words are taken, what is refused, and the pages that are made from them.
#include "core/base/options.h"

#include <gmock/gmock.h>

#include <filesystem>

#include "core/base/option_pages.h"

namespace indurop::base {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using Outcome = Options::Outcome;

struct Sample {
  Sample() {
    options.add("files", "FILE", files, "Files to read");
    options.add("-n,--count", "COUNT", count, "How many").range(1, 9);
    options.add("--rate", "RATE", rate, "How often");
    options.add("--core", "N", core, "Which core");
    options.add("--peer", "ADDRESS", peers, "Whom to ask").one_at_a_time();
    options.add("--form", "FORM", form, "In which form").choices({"short", "long"});
    const Option board = options.add("--board", "NAME", board_name, "Which board");
    options.flag("--one-host", one_host, "All here").needs(board);
    options.flag("-q,--quiet", quiet, "Say less");
    options.add("--dir", "DIR", folder, "Where").implies(folder_given);
    options.version("sample 1");
    options.details("It is a sample.\n");
  }

  Options::Result parse(std::vector<std::string> words) { return options.parse(std::move(words)); }

  Options options{"sample", "Show how it is done"};
  std::vector<std::string> files;
  std::vector<std::string> peers;
  std::uint64_t count = 0;
  double rate = 1;
  std::optional<int> core;
  std::string form;
  std::string board_name;
  std::filesystem::path folder;
  bool folder_given = false;
  bool one_host = false;
  bool quiet = false;
};

TEST(Options, Words_are_taken_in_any_order) {
  Sample sut;
  const auto result = sut.parse({"a", "--count=3", "b", "-q", "--rate", "2.5", "--core", "1", "--dir", "x"});
  EXPECT_EQ(result.outcome, Outcome::Parsed) << result.text;
  EXPECT_THAT(sut.files, ElementsAre("a", "b"));
  EXPECT_EQ(sut.count, 3U);
  EXPECT_EQ(sut.rate, 2.5);
  EXPECT_EQ(sut.core, 1);
  EXPECT_TRUE(sut.quiet);
  EXPECT_EQ(sut.folder, "x");
  EXPECT_TRUE(sut.folder_given);
}

TEST(Options, What_is_not_given_keeps_what_it_holds) {
  Sample sut;
  EXPECT_EQ(sut.parse({}).outcome, Outcome::Parsed);
  EXPECT_EQ(sut.rate, 1);
  EXPECT_FALSE(sut.core);
  EXPECT_FALSE(sut.folder_given);
}

TEST(Options, Negative_numbers_and_brackets_are_values) {
  Sample sut;
  EXPECT_EQ(sut.parse({"gain", "-2.5", "-inf", "[1, 2]", "--core", "-1", "--rate", "-.5"}).outcome, Outcome::Parsed);
  EXPECT_THAT(sut.files, ElementsAre("gain", "-2.5", "-inf", "[1, 2]"));
  EXPECT_EQ(sut.core, -1);
  EXPECT_EQ(sut.rate, -0.5);
}

TEST(Options, After_two_dashes_nothing_is_an_option) {
  Sample sut;
  EXPECT_EQ(sut.parse({"--", "-q", "--count"}).outcome, Outcome::Parsed);
  EXPECT_THAT(sut.files, ElementsAre("-q", "--count"));
  EXPECT_FALSE(sut.quiet);
}

TEST(Options, Of_two_values_the_last_counts_and_of_a_list_all) {
  Sample sut;
  EXPECT_EQ(sut.parse({"-n", "2", "-n", "3", "--peer", "a", "x", "--peer", "b"}).outcome, Outcome::Parsed);
  EXPECT_EQ(sut.count, 3U);
  EXPECT_THAT(sut.peers, ElementsAre("a", "b"));
  EXPECT_THAT(sut.files, ElementsAre("x"));
}

TEST(Options, What_is_wrong_names_the_option) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{"--count", "x"}, "--count: 'x' is not a whole number from 0 on"},
      {{"--count", "-1"}, "--count: -1 is not in the range 1 to 9"},
      {{"--count", "10"}, "--count: 10 is not in the range 1 to 9"},
      {{"--rate", "fast"}, "--rate: 'fast' is not a number"},
      {{"--core", "1.5"}, "--core: '1.5' is not a whole number"},
      {{"--form", "wide"}, "--form: 'wide' is not one of short|long"},
      {{"--form"}, "--form: FORM is missing"},
      {{"--quiet=3"}, "--quiet takes no value"},
      {{"--one-host"}, "--one-host requires --board"},
      {{"--cuont=3"}, "there is no option --cuont; did you mean --count?"},
      {{"--zzzzz"}, "there is no option --zzzzz"},
      {{"--count", "x", "--", "in.xml"}, "--count: 'x' is not a whole number from 0 on"},
  };
  for (const auto& [words, text] : cases) {
    Sample sut;
    const auto result = sut.parse(words);
    EXPECT_EQ(result.outcome, Outcome::Wrong);
    EXPECT_THAT(result.text, HasSubstr(text));
  }
}

TEST(Options, What_is_missing_or_too_much_is_named_as_the_help_names_it) {
  Options sut("sample", "Show how it is done");
  std::string file;
  std::string name;
  sut.add("file", "FILE", file, "What to read").required();
  sut.add("-b,--board", "NAME", name, "Which board").required();
  EXPECT_EQ(sut.parse({"-b", "x"}).text, "FILE is missing");
  EXPECT_EQ(sut.parse({"-b", "x", "--flie"}).text, "there is no option --flie");
  EXPECT_EQ(sut.parse({"in.xml"}).text, "--board NAME is missing");
  EXPECT_EQ(sut.parse({"in.xml", "-b", "x", "more", "-1"}).text, "'more', '-1' are too much");
}

TEST(Options, An_argument_and_an_option_may_have_the_same_name) {
  Options sut("sample", "Show how it is done");
  std::string from;
  std::string to;
  sut.add("file", "FROM", from, "What to read").required();
  sut.add("-o,--file", "TO", to, "What to write").required();
  EXPECT_EQ(sut.parse({"in.xml", "--file", "out.xml"}).outcome, Outcome::Parsed);
  EXPECT_EQ(from + " " + to, "in.xml out.xml");
  EXPECT_THAT(sut.parse({"--help"}).text, AllOf(HasSubstr("file FROM"), Not(HasSubstr("_file"))));
}

TEST(Options, Words_of_a_command_are_judged_by_its_own_options) {
  Options sut("sample", "Show how it is done");
  std::uint64_t count = 0;
  sut.command("show", "Show them", [] {}).add("--count", "N", count, "How many");
  EXPECT_EQ(sut.parse({}).text, "a command is missing");
  EXPECT_EQ(sut.parse({"show", "--coutn", "1"}).text, "there is no option --coutn; did you mean --count?");
  EXPECT_EQ(sut.parse({"show", "x"}).text, "'x' is not expected here");
  EXPECT_EQ(sut.parse({"shwo"}).text, "there is no command 'shwo'; did you mean show?");
}

TEST(Options, Words_that_name_no_command_mean_list) {
  const auto chosen_by = [](std::vector<std::string> words) {
    Options sut("sample", "Show how it is done");
    std::string chosen;
    bool all = false;
    sut.flag("--all", all, "Everything");
    sut.command("make", "Make one", [&] { chosen = "make"; });
    sut.command("list", "List them", [&] { chosen = "list"; });
    const auto result = sut.parse(std::move(words));
    return result.outcome == Outcome::Parsed ? chosen + (all ? " all" : "") : result.text;
  };
  EXPECT_EQ(chosen_by({}), "list");
  EXPECT_EQ(chosen_by({"--all"}), "list all");
  EXPECT_EQ(chosen_by({"make", "--all"}), "make all");
  EXPECT_EQ(chosen_by({"--all", "make"}), "make all");
  EXPECT_EQ(chosen_by({"mak"}), "there is no command 'mak'; did you mean make?");
  EXPECT_THAT(chosen_by({"--help"}), HasSubstr("List them"));
}

TEST(Options, Another_command_than_list_can_be_meant) {
  Options sut("sample", "Show how it is done");
  std::string chosen;
  sut.usual_command("show");
  sut.command("list", "List them", [&] { chosen = "list"; });
  sut.command("show", "Show them", [&] { chosen = "show"; });
  EXPECT_EQ(sut.parse({}).outcome, Outcome::Parsed);
  EXPECT_EQ(chosen, "show");
}

TEST(Options, The_error_of_a_moved_option_names_its_new_form) {
  Sample sut;
  sut.options.moved("--all", "sample list");
  const auto result = sut.parse({"in.xml", "--all", "x"});
  EXPECT_EQ(result.outcome, Outcome::Wrong);
  EXPECT_EQ(result.text, "--all was replaced: use sample list");
  EXPECT_THAT(sut.parse({"--help"}).text, Not(HasSubstr("--all")));
  EXPECT_EQ(sut.parse({"in.xml"}).outcome, Outcome::Parsed);
}

TEST(Options, Help_and_version_are_printed) {
  Sample sut;
  const auto help = sut.parse({"--help"});
  EXPECT_EQ(help.outcome, Outcome::Info);
  EXPECT_THAT(help.text, HasSubstr("-n,--count COUNT"));
  EXPECT_THAT(help.text, HasSubstr("It is a sample."));
  EXPECT_EQ(sut.parse({"--version"}).text, "sample 1\n");
}

TEST(Options, Verbs_have_options_of_their_own) {
  Options sut("tool", "Do things");
  std::string name;
  int chosen = 0;
  sut.command("make", "Make it", [&] { chosen = 1; }).add("name", "NAME", name, "Which").required();
  sut.command("list", "List all", [&] { chosen = 2; });
  EXPECT_EQ(sut.parse({"make"}).outcome, Outcome::Wrong);
  EXPECT_EQ(sut.parse({"make", "it"}).outcome, Outcome::Parsed);
  EXPECT_EQ(chosen, 1);
  EXPECT_EQ(name, "it");
}

TEST(Pages, Every_form_has_every_option_and_verb) {
  Sample sample;
  bool all = false;
  sample.options.command("show", "Show it", [] {}).flag("--all-of-it", all, "Everything");
  const CommandText text = sample.options.text();
  for (const char* form : {"man", "markdown", "bash", "zsh", "fish"}) {
    const std::string page = page_of(text, form).value_or("");
    for (const OptionText& option : text.options) {
      std::string name = option.positional ? option.value : option.long_name.substr(2);
      if (std::string(form) == "man" && name == "one-host") {
        name = "one\\-host";
      }
      const bool shown = !option.positional || std::string(form) == "man" || std::string(form) == "markdown";
      EXPECT_TRUE(!shown || page.find(name) != std::string::npos) << form << " " << name;
    }
    EXPECT_THAT(page, HasSubstr("show")) << form;
    EXPECT_THAT(page, HasSubstr(std::string(form) == "man" ? "all\\-of\\-it" : "all-of-it")) << form;
  }
  EXPECT_FALSE(page_of(text, "pdf"));
}

TEST(Pages, Text_cannot_be_taken_for_commands_of_troff) {
  Options sut("tool", "Do 'things'");
  sut.details(".SH not a heading\n'also not\n\\fBnot bold\n");
  const std::string page = man_page(sut.text());
  EXPECT_THAT(page, HasSubstr("\n\\&.SH not a heading\n\\(aqalso not\n\\efBnot bold\n"));
}

}  // namespace
}  // namespace indurop::base
