// SPDX-License-Identifier: Apache-2.0
// An error, warning or note about something a user wrote, with its place.

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/base/source_place.h"

namespace indurop::base {

struct Diagnostic {
  enum class Severity { Error, Warning, Note } severity = Severity::Error;
  std::string file;  // as the user named it; empty: not about a file
  SourcePlace place;
  std::string text;       // what is wrong, and what to do
  std::string within{};   // for drawings: the element, "POU main, rung 3"
  std::string picture{};  // the source line and a mark below, as picture_of_line() makes them; empty: not shown
};

// The line of a diagnostic in parts, for programs that colour the word: "module.xml:12:5: ", "error:", " ...".
struct DiagnosticLine {
  std::string place;
  std::string word;
  std::string text;
};
[[nodiscard]] DiagnosticLine line_of(const Diagnostic& diagnostic, std::string_view program = {});
// Returns the parts of line_of() as one text, "module.xml:12:5: error: ..." ; line and column are left out when 0. One
// line, even if a name in the file contains line breaks, without the picture. A diagnostic that is not about a file
// begins with `program`, if given: "glb2idl: error: ...".
[[nodiscard]] std::string to_string(const Diagnostic& diagnostic, std::string_view program = {});
// Returns all diagnostics, each with its picture and followed by a line break.
[[nodiscard]] std::string to_text(const std::vector<Diagnostic>& diagnostics, std::string_view program = {});
[[nodiscard]] bool has_error(const std::vector<Diagnostic>& diagnostics) noexcept;

// Sorts by line and column; diagnostics without a line come last. For diagnostics about one file.
void sort_by_place(std::vector<Diagnostic>& diagnostics);
// Sorts files in the order of `first`, then in the order in which they first appear; within a file by line and column,
// those without a line first.
void sort_by_file(std::vector<Diagnostic>& diagnostics, const std::vector<std::string>& first = {});

}  // namespace indurop::base
