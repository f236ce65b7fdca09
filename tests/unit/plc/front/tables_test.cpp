// SPDX-License-Identifier: Apache-2.0
// The rows of docs/plc-conformance.md: what they say compiles does, and what they say does not is an error.

#include <gmock/gmock.h>

#include <array>
#include <fstream>
#include <string>
#include <vector>

#include "tests/unit/plc/front/compiled.h"

namespace indurop::plc {
namespace {

using testing::compiled;
using testing::messages;

struct Row {
  std::string name;
  std::string text;
  std::string answer;
};

// "| 13 | sections | `VAR ...` | yes | pous |"
std::vector<Row> rows_of(const std::string& file) {
  std::vector<Row> out;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    const std::size_t first = line.find("| `", line.find("| ", 2) + 2);
    const std::size_t end = line.rfind("` |");
    if (line.starts_with("| ") && first != std::string::npos && end != std::string::npos && first + 3 < end) {
      out.push_back({line.substr(0, first), line.substr(first + 3, end - first - 3), line.substr(end + 4, 3)});
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
  const std::vector<Row> rows = rows_of(PLC_CONFORMANCE);
  EXPECT_GT(rows.size(), 70U);
  for (const Row& row : rows) {
    const Compiled sut = compiled(project_of(row.text));
    const bool yes = row.answer == "yes";
    EXPECT_TRUE(yes || row.answer.starts_with("no")) << row.name;
    EXPECT_EQ(sut.ok, yes) << row.name << row.text << '\n' << messages(sut);
  }
}

}  // namespace
}  // namespace indurop::plc
