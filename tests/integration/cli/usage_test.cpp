// SPDX-License-Identifier: Apache-2.0
// Wrong usage, help, output that goes nowhere.
#include <sstream>

#include "fixture.h"

namespace indurop::test {
namespace {

TEST_F(CommandLine, Unknown_verb_is_answered_with_the_nearest) {
  const auto sut = indurop({"statsu"});
  EXPECT_EQ(sut.code, 2);
  EXPECT_THAT(sut.err, HasSubstr("Did you mean 'status'?"));
  EXPECT_THAT(sut.out, IsEmpty());
}

TEST_F(CommandLine, Without_a_verb_it_says_so) {
  EXPECT_EQ(indurop({}).code, 2);
}

TEST_F(CommandLine, Help_lists_every_verb_and_each_has_its_own) {
  const auto all = indurop({"help"});
  EXPECT_EQ(all.code, 0);
  for (const char* verb : {"new", "check", "plan", "doctor", "stop", "reset", "clean", "status", "nodes", "vars", "get",
                           "set", "watch", "hz", "jitter", "overruns", "log", "audit"}) {
    EXPECT_THAT(all.out, HasSubstr(std::string("\n  ") + verb + " "));
    const auto one = indurop({"help", verb});
    EXPECT_EQ(one.code, 0) << verb;
    EXPECT_THAT(one.out, HasSubstr(std::string("Usage: indurop ") + verb)) << verb;
    EXPECT_EQ(indurop({verb, "--help"}).out, one.out) << verb;
  }
}

TEST_F(CommandLine, Version_is_printed) {
  const auto sut = indurop({"--version"});
  EXPECT_EQ(sut.code, 0);
  EXPECT_THAT(sut.out, ContainsRegex("^indurop [0-9]+[.][0-9]+[.][0-9]+\n$"));
}

TEST_F(CommandLine, Wrong_options_are_usage_errors_that_point_to_the_help) {
  for (const auto& words : std::vector<std::vector<std::string>>{{"status", "--nodee"},
                                                                 {"status", "-o", "xml"},
                                                                 {"get"},
                                                                 {"watch", "--hz", "0", "x"},
                                                                 {"watch", "--timeout", "soon", "x"},
                                                                 {"nodes", "--color", "blue"},
                                                                 {"jitter", "--quantity", "mood"},
                                                                 {"reset"}}) {
    const auto sut = indurop(words);
    EXPECT_EQ(sut.code, 2) << words[0] << " " << sut.err;
    EXPECT_THAT(sut.err, Not(IsEmpty()));
    EXPECT_THAT(sut.out, IsEmpty());
  }
}

TEST_F(CommandLine, Options_may_stand_before_the_verb) {
  const auto sut = indurop({"-o", "json", "nodes"});
  EXPECT_EQ(sut.code, 0);
  EXPECT_EQ(sut.json()["schema_version"], 1);
}

TEST_F(CommandLine, Without_a_node_it_says_how_to_start_one) {
  for (const char* verb : {"status", "vars", "jitter", "overruns", "log"}) {
    const auto sut = indurop({verb});
    EXPECT_EQ(sut.code, 6) << verb;
    EXPECT_THAT(sut.err, HasSubstr("indurop run module.xml")) << verb;
  }
  EXPECT_EQ(indurop({"watch", "*"}).code, 6);
  EXPECT_EQ(indurop({"get", "x"}).code, 6);
  EXPECT_EQ(indurop({"set", "x", "1"}).code, 6);
  const auto nodes = indurop({"nodes"});
  EXPECT_EQ(nodes.code, 0);
  EXPECT_THAT(nodes.err, HasSubstr("no node"));
}

TEST_F(CommandLine, What_fails_is_said_in_json_too) {
  for (const auto& [words, name] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{"status", "-o", "json"}, "unreachable"},
           {{"get", "x", "-o", "json"}, "unreachable"},
           {{"get", "x", "-o", "json", "--hertz"}, "usage"}}) {
    const auto sut = indurop(words);
    EXPECT_NE(sut.code, 0);
    EXPECT_THAT(sut.err, Not(IsEmpty())) << "people read it there";
    const auto json = sut.json();
    EXPECT_EQ(json["schema_version"], 1) << sut.out;
    EXPECT_EQ(json["error"]["exit_code"], sut.code);
    EXPECT_EQ(json["error"]["name"], name);
    EXPECT_FALSE(json["error"]["messages"].empty());
  }
}

TEST_F(CommandLine, A_file_that_is_not_there_gives_every_verb_one_message_and_code) {
  for (const char* verb : {"run", "check", "plan", "deploy"}) {
    const auto sut = indurop({verb, "no_such.xml"});
    EXPECT_EQ(sut.code, 1) << verb;
    EXPECT_THAT(sut.err, HasSubstr("there is no file 'no_such.xml'")) << verb;
  }
}

TEST_F(CommandLine, Impossible_node_names_are_usage_errors) {
  EXPECT_EQ(indurop({"status", "--node", "../../etc/passwd"}).code, 2);
  EXPECT_EQ(indurop({"status"}, {.variables = {"INDUROP_NODE=a b"}}).code, 2);
  EXPECT_EQ(indurop({"clean", "--node", "a/b"}).code, 2);
}

TEST_F(CommandLine, Full_disk_behind_stdout_is_an_error) {
  const auto sut = indurop({"help"}, {.stdout_to = "/dev/full"});
  EXPECT_EQ(sut.code, 1);
  EXPECT_THAT(sut.err, HasSubstr("No space left on device"));
}

TEST_F(CommandLine, Colour_only_when_asked_for_in_a_pipe) {
  EXPECT_THAT(indurop({"help"}).out, Not(HasSubstr("\x1b[")));
  EXPECT_THAT(indurop({"--color", "always", "statsu"}).code, 2);
  EXPECT_THAT(indurop({"doctor", "--no-test", "--color", "always"}).out, HasSubstr("\x1b["));
  EXPECT_THAT(indurop({"doctor", "--no-test", "--color", "never"}).out, Not(HasSubstr("\x1b[")));
}

TEST_F(CommandLine, Doctor_grades_every_check_in_json) {
  const auto sut = indurop({"doctor", "--duration", "100ms", "-o", "json"});
  const auto json = sut.json();
  ASSERT_TRUE(json.is_object()) << sut.out;
  EXPECT_EQ(sut.code, json["fit"] == true ? 0 : 1);
  EXPECT_GE(json["checks"].size(), 10U);
  for (const auto& check : json["checks"]) {
    EXPECT_TRUE(check["grade"] == "OK" || check["grade"] == "WARN" || check["grade"] == "FAIL");
  }
}

TEST_F(CommandLine, Doctor_tune_shows_settings_in_json) {
  const auto sut = indurop({"doctor", "tune", "--core", "0", "-o", "json"});
  EXPECT_EQ(sut.code, 0) << sut.err;
  const auto json = sut.json();
  EXPECT_EQ(json["core"], 0);
  EXPECT_TRUE(json["settings"].is_array()) << sut.out;
}

TEST_F(CommandLine, Options_that_were_replaced_by_verbs_name_these) {
  for (const auto& [words, now] : std::vector<std::pair<std::vector<std::string>, const char*>>{
           {{"doctor", "--tune"}, "use indurop doctor tune (see"},
           {{"doctor", "--tune", "--apply"}, "use indurop doctor tune"},
           {{"doctor", "--apply", "--core", "1"}, "use indurop doctor tune --apply (see"},
           {{"doctor", "--undo"}, "use indurop doctor undo (see"},
           {{"log", "--audit", "-n", "5"}, "use indurop audit (see"},
           {{"log", "--audit-file", "audit.jsonl"}, "use indurop audit --file (see"}}) {
    const auto sut = indurop(words);
    EXPECT_EQ(sut.code, 2) << now;
    EXPECT_THAT(sut.err, HasSubstr(now));
  }
}

// Only job files are changed, and only if they have to be.
TEST_F(CommandLine, Job_files_are_laid_out) {
  const std::string job = "LOOP\n  MOVJ P1\nEND\n";
  const std::string library("loop\n  \0 end\n", 13);
  put("a.job", "loop\nmovj P1\nend\n");
  put("b.job", job);
  put("binary.job", library);
  put("module.xml", " <root/>\n");
  const auto checked = indurop({"robot", "format", "--check", "a.job", "b.job"});
  EXPECT_EQ(checked.code, 4);
  EXPECT_EQ(checked.out, "a.job is not formatted\n");
  const auto sut = indurop({"robot", "format", "a.job", "b.job", "binary.job", "module.xml", "missing.job"});
  EXPECT_EQ(sut.code, 1);
  EXPECT_EQ(sut.out, "formatted a.job\n");
  for (const char* const refused :
       {"binary.job is no job file", "module.xml is no job file", "cannot read missing.job"}) {
    EXPECT_THAT(sut.err, HasSubstr(refused));
  }
  const auto content = [](const char* file) {
    std::stringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
  };
  EXPECT_EQ(content("a.job"), job);
  EXPECT_EQ(content("binary.job"), library);
  EXPECT_EQ(content("module.xml"), " <root/>\n");
  EXPECT_EQ(indurop({"robot", "format", "--check", "a.job", "b.job"}).code, 0);
}

}  // namespace
}  // namespace indurop::test
