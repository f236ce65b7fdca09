// SPDX-License-Identifier: Apache-2.0
// The rows of docs/plc-conformance.md: what they say compiles does, and what they say does not is an error.

#include <gmock/gmock.h>

#include <array>
#include <cctype>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "control/plc/library/standard.h"
#include "control/plc/model/elementary.h"
#include "tests/unit/control/plc/front/compiled.h"

namespace indurop::plc {
namespace {

using testing::compiled;
using testing::messages;

struct TableRow {
  std::string name;
  std::string text;
  std::string answer;
  std::string run_in;
};

// "| 13 | sections | `VAR ...` | yes | pous |"
std::vector<TableRow> rows_of(const std::string& file) {
  std::vector<TableRow> out;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    const std::size_t first = line.find("| `", line.find("| ", 2) + 2);
    const std::size_t end = line.rfind("` |");
    if (line.starts_with("| ") && first != std::string::npos && end != std::string::npos && first + 3 < end) {
      const std::size_t run = std::min(line.find("| ", end + 3) + 2, line.size());
      out.push_back({line.substr(0, first), line.substr(first + 3, end - first - 3), line.substr(end + 4, 3),
                     line.substr(run, std::max(line.rfind(" |"), run) - run)});
    }
  }
  return out;
}

// A whole project of a declaration, or of statements.
std::string project_of(const std::string& text) {
  constexpr const char* kVariables =
      " VAR i, j : INT; n : DINT; u : UINT; r : REAL; l : LREAL; b : BOOL; by_ : BYTE; w : WORD; dw : DWORD; s : "
      "STRING; "
      "t : TIME; d : DATE; tod_ : TIME_OF_DAY; dt_ : DATE_AND_TIME; a : ARRAY[1..3] OF INT; timer : TON; END_VAR\n";
  constexpr std::array kDeclarations{"FUNCTION",  "TYPE",       "CLASS",         "INTERFACE",
                                     "NAMESPACE", "VAR_GLOBAL", "CONFIGURATION", "PROGRAM"};
  for (const char* word : kDeclarations) {
    if (text.starts_with(word)) {
      return text + (text.find("END_PROGRAM") == std::string::npos
                         ? "\nPROGRAM Main VAR k : INT; END_VAR k := 1; END_PROGRAM"
                         : "");
    }
  }
  return "PROGRAM Main" + std::string(kVariables) + text + "\nEND_PROGRAM";
}

TEST(PlcTables, Rows_are_true) {
  const std::vector<TableRow> rows = rows_of(PLC_CONFORMANCE);
  EXPECT_GT(rows.size(), 70U);
  for (const TableRow& row : rows) {
    const Compiled sut = compiled(project_of(row.text));
    const bool yes = row.answer == "yes";
    EXPECT_TRUE(yes || row.answer.starts_with("no")) << row.name;
    EXPECT_EQ(sut.ok, yes) << row.name << row.text << '\n' << messages(sut);
  }
}

// Of the programs and tests with these names: "blocks, rows".
std::string table_contents(const std::string& names) {
  std::string all;
  std::istringstream list(names);
  for (std::string name; std::getline(list >> std::ws, name, ',');) {
    bool found = false;
    for (const char* folder : {"unit/control/plc/conformance/", "unit/control/plc/drawn/", "unit/control/plc/front/",
                               "unit/control/plc/program/", "integration/cli/"}) {
      for (const char* ending : {".st", ".cpp"}) {
        std::ifstream in(PLC_TESTS + ("/" + std::string(folder)) + name + ending);
        found = found || in.good();
        all += std::string(std::istreambuf_iterator<char>(in), {});
      }
    }
    EXPECT_TRUE(found) << "there is no test '" << name << "'";
  }
  return upper(all);
}

// The functions and blocks of the library that a text names.
std::set<std::string> library_names(const std::string& text) {
  std::set<std::string> out;
  std::string word;
  for (const char c : upper(text) + ' ') {
    if ((std::isalnum(static_cast<unsigned char>(c)) != 0) || c == '_') {
      word += c;
      continue;
    }
    if (word.size() > 1 && (find_block(word) != nullptr || !find_functions(word).empty())) {
      out.insert(word);
    }
    word.clear();
  }
  return out;
}

// That it compiles is not enough: a program runs it and checks the results.
TEST(PlcTables, What_compiles_is_run_by_the_test_that_the_row_names) {
  for (const TableRow& row : rows_of(PLC_CONFORMANCE)) {
    if (row.answer != "yes") {
      continue;
    }
    EXPECT_FALSE(row.run_in.empty()) << row.name;
    const std::string contents = table_contents(row.run_in);
    for (const std::string& name : library_names(row.text)) {
      EXPECT_NE(contents.find(name), std::string::npos) << row.name << ": no " << name << " in " << row.run_in;
    }
  }
}

}  // namespace
}  // namespace indurop::plc
