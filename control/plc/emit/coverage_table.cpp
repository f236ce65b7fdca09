// SPDX-License-Identifier: Apache-2.0
#include "control/plc/emit/coverage_table.h"

#include <fmt/format.h>

#include <algorithm>

namespace indurop::plc {
namespace {

const char* word_of(CoverageTable::Kind kind) {
  switch (kind) {
    case CoverageTable::Kind::Statement:
      return "statement";
    case CoverageTable::Kind::Branch:
      return "branch";
    case CoverageTable::Kind::Coil:
      return "coil";
  }
  return "";
}

// Returns the text as a field of a line separated by tabs.
std::string field(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
  return text;
}

}  // namespace

std::string to_text(const CoverageTable& table) {
  std::string out;
  for (const CoverageTable::Point& one : table.points) {
    out += fmt::format("{}\t{}\t{}\t{}\t{}\t{}\n", word_of(one.kind), one.counter,
                       field(one.at.file ? *one.at.file : std::string()), one.at.line,
                       field(one.at.within ? *one.at.within : std::string()), field(one.pou));
  }
  return out;
}

}  // namespace indurop::plc
