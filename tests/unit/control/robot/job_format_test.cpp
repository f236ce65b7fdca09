// SPDX-License-Identifier: Apache-2.0
// The layout of job files: what it changes, that it changes nothing else, and that the files of this project have it.
#include <gmock/gmock.h>

#include <cctype>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "control/robot/job/format.h"
#include "control/robot/job/text.h"

namespace indurop::robot {
namespace {

namespace fs = std::filesystem;

std::string formatted(const std::string& text) {
  return format_job({"main.job", text});
}

TEST(JobFormat, Blocks_are_indented_and_words_of_the_language_are_upper_case) {
  EXPECT_EQ(formatted("\xEF\xBB\xBF\n\n  var n = 1   # how many \r\n"
                      "point Home=joint 0 0 0 0 0 0\n\n\n"
                      "for i=1 to 3\n"
                      "// each of them\n"
                      "movl Home offset 0, 0, max(10*n, x(Home)) SPEED 100 MM/S  // slowly\n"
                      "if n > 2 goto out\n"
                      "switch n\n# the first one\ncase 1\nwait i4 timeout 2S else\nset o1 on\nend\ndefault\ntry\n"
                      "raise 5, \"no  part: \", n\n"
                      "recover\nexit\nend\nend\n"
                      "      end\nlabel out"),
            "VAR n = 1   # how many\n"
            "POINT Home=JOINT 0 0 0 0 0 0\n\n"
            "FOR i=1 TO 3\n"
            "  // each of them\n"
            "  MOVL Home OFFSET 0, 0, MAX(10*n, X(Home)) SPEED 100 mm/s  // slowly\n"
            "  IF n > 2 GOTO out\n"
            "  SWITCH n\n"
            "  # the first one\n"
            "  CASE 1\n"
            "    WAIT i4 TIMEOUT 2s ELSE\n"
            "      SET o1 ON\n"
            "    END\n"
            "  DEFAULT\n"
            "    TRY\n"
            "      RAISE 5, \"no  part: \", n\n"
            "    RECOVER\n"
            "      EXIT\n"
            "    END\n"
            "  END\n"
            "END\n"
            "LABEL out\n");
  EXPECT_EQ(formatted(""), "");
  EXPECT_EQ(formatted(" \n\n"), "");
  EXPECT_EQ(formatted("# only this\n\n"), "# only this\n");
}

TEST(JobFormat, Lines_with_errors_are_kept_from_the_error_on) {
  EXPECT_EQ(formatted("loop\nmovl speed\nmovx a\nwait 1 hour \nend\nend\nelse\nloop\nmovl P1\n"),
            "LOOP\n  MOVL speed\n  movx a\n  WAIT 1 hour\nEND\nEND\nELSE\nLOOP\n  MOVL P1\n");
}

// Files of this project.
std::vector<fs::path> job_files() {
  std::vector<fs::path> all;
  for (const char* const folder : {"examples", "tests/unit/control/robot/topics"}) {
    for (const auto& each : fs::recursive_directory_iterator(fs::path(PROJECT_FILES) / folder)) {
      if (each.path().extension() == ".job") {
        all.push_back(each.path());
      }
    }
  }
  return all;
}

std::string content(const fs::path& file) {
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

TEST(JobFormat, The_files_of_this_project_have_it) {
  ASSERT_GT(job_files().size(), 25U);
  for (const fs::path& file : job_files()) {
    EXPECT_EQ(formatted(content(file)), content(file)) << file;
  }
}

// Other blanks at the beginning and the end of lines, empty lines, other ends of lines, words in lower case.
std::string disordered(const std::string& text, std::mt19937& random) {
  const auto blanks = [&] { return std::string(std::uniform_int_distribution<std::size_t>(0, 9)(random), ' '); };
  const auto chance = [&] { return std::uniform_int_distribution<int>(0, 4)(random) == 0; };
  std::string to;
  for (JobLines lines(text); !lines.at_end();) {
    std::string line(lines.take());
    if (line.empty() && chance()) {
      to += blanks() + "\n";
    }
    for (const JobToken& token : split_job_line(line)) {
      static constexpr std::string_view kWords[] = {"MOVL", "MOVJ", "OFFSET", "SPEED", "SET",  "ON",   "END", "ELSE",
                                                    "IF",   "CASE", "CALL",   "ZONE",  "WAIT", "LOOP", "TRY", "POSE"};
      const bool known = std::find(std::begin(kWords), std::end(kWords), token.text) != std::end(kWords);
      for (std::size_t i = 0; known && chance() && i < token.text.size(); ++i) {
        char& letter = line[token.column - 1 + i];
        letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
      }
    }
    const std::size_t first = std::min(line.find_first_not_of(' '), line.size());
    to += (line.empty() ? "" : blanks() + line.substr(first)) + (chance() ? "\t" : "") + (chance() ? "\r\n" : "\n");
  }
  return to;
}

TEST(JobFormat, Disordered_files_become_what_they_were) {
  std::mt19937 random(7);
  for (const fs::path& file : job_files()) {
    const std::string text = content(file);
    for (int i = 0; i < 20; ++i) {
      ASSERT_EQ(formatted(disordered(text, random)), text) << file;
    }
  }
}

// Random lines of random words: nothing but blanks and the case of letters changes, and only once.
TEST(JobFormat, Nothing_else_changes_whatever_the_text_is) {
  static constexpr const char* kParts[] = {"movl", "P1",   "IF",   "end",  "\"a b\"", "#",    "//", "=",    "(",
                                           ")",    "loop", "ELSE", "try",  "mm",      "/",    "s",  "12.5", "a[1]",
                                           ",",    "set",  "on",   "WAIT", "recover", "CASE", "\t", "\r",   "\x01"};
  std::mt19937 random(3);
  const auto bare = [](const std::string& text) {
    std::string to;
    for (const char c : text) {
      if (c != ' ' && c != '\t' && c != '\r' && c != '\n') {
        to += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      }
    }
    return to;
  };
  for (int run = 0; run < 2000; ++run) {
    std::string text;
    for (int i = 0; i < 60; ++i) {
      text += kParts[std::uniform_int_distribution<std::size_t>(0, std::size(kParts) - 1)(random)];
      text += std::uniform_int_distribution<int>(0, 3)(random) == 0 ? "\n" : " ";
    }
    const std::string once = formatted(text);
    ASSERT_EQ(bare(once), bare(text)) << text;
    ASSERT_EQ(formatted(once), once) << text;
  }
}

}  // namespace
}  // namespace indurop::robot
