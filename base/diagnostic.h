// SPDX-License-Identifier: Apache-2.0
// What is wrong with something a user wrote, with the place it was written at.

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/source_place.h"

namespace indurop::base {

struct Diagnostic {
  enum class Severity { Error, Warning, Note } severity = Severity::Error;
  std::string file;  // as the user named it; empty: about no file
  SourcePlace place;
  std::string text;       // what, and what to do
  std::string within{};   // of what is drawn: the element, "POU main, rung 3"
  std::string picture{};  // the source line and a mark below, as picture_of_line() makes them; empty: not shown
};

// "module.xml:12:5: error: ..." ; line and column left out when 0. One line, whatever a name in the file holds, without
// the picture. What is about no file is said by `program`, if it is given: "glb2idl: error: ...".
[[nodiscard]] std::string to_string(const Diagnostic& diagnostic, std::string_view program = {});
// One below the other, each with its picture, and a line break behind each.
[[nodiscard]] std::string to_text(const std::vector<Diagnostic>& diagnostics, std::string_view program = {});
[[nodiscard]] bool has_error(const std::vector<Diagnostic>& diagnostics) noexcept;

// By line and column; what has no line comes last. For diagnostics about one file.
void sort_by_place(std::vector<Diagnostic>& diagnostics);
// Files in the order of `first`, then in the order in which they are first complained about; within a file by line and
// column, what has no line first.
void sort_by_file(std::vector<Diagnostic>& diagnostics, const std::vector<std::string>& first = {});

}  // namespace indurop::base
