// SPDX-License-Identifier: Apache-2.0
// The options of a node, as indurop run hands them on.
#include "config/run_options.h"

#include <gtest/gtest.h>

namespace indurop::config {
namespace {

base::Options::Result parse(const std::vector<std::string>& words, RunOptions& to) {
  base::Options line("test", "a test");
  declare_run_options(line, to);
  line.flag("-q,--quiet", to.quiet, "quiet");
  return line.parse(words);
}

TEST(RunOptions, Words_of_options_say_the_same_options) {
  const std::vector<std::vector<std::string>> lines{
      {},
      {"--node", "a", "--", "module.xml"},
      {"--board", "left", "--one-host", "--deployment", "12ab", "--", "plant.xml"},
      {"--duration", "1500ns", "--report", "r.json", "--require-rt", "--adjust", "--core", "-1", "--spin", "auto",
       "--quiet", "--", "-odd.xml"},
      {"--spin", "off", "--", "m.xml"},
      {"--spin", "20000ns", "--", "m.xml"},
  };
  for (const auto& words : lines) {
    RunOptions options;
    EXPECT_EQ(parse(words, options).text, "");
    EXPECT_EQ(words_of(options), words);
  }
}

TEST(RunOptions, What_cannot_be_is_refused) {
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{{"--duration", "soon"},
                                                                                     {"--node", "a b"},
                                                                                     {"--core", "x"},
                                                                                     {"--spin", "-1"},
                                                                                     {"--one-host"},
                                                                                     {"--nonsense"},
                                                                                     {"a.xml", "b.xml"}}) {
    RunOptions options;
    EXPECT_EQ(parse(words, options).outcome, base::Options::Outcome::Wrong) << words.front();
  }
}

}  // namespace
}  // namespace indurop::config
