// SPDX-License-Identifier: Apache-2.0
// Collects the errors and warnings of readers and checker about a PLC program. It adds what these languages need:
// places share the names of their files and may be elements of a drawing, and texts of files are known only for a
// while.

#pragma once

#include <map>
#include <string>
#include <vector>

#include "control/plc/model/source_place.h"
#include "core/base/diagnostics.h"

namespace indurop::plc {

class Diagnostics {
 public:
  Diagnostics() = default;
  Diagnostics(const Diagnostics&) = delete;
  Diagnostics& operator=(const Diagnostics&) = delete;

  // Adds an error. Text: what is wrong, then what to do. The same text at the same place is kept once; at most 100
  // errors are kept.
  void error(const Place& at, std::string text) { add(base::Diagnostic::Severity::Error, at, std::move(text)); }
  void warning(const Place& at, std::string text) { add(base::Diagnostic::Severity::Warning, at, std::move(text)); }

  // Sets the text of a file whose lines are shown below messages about it from now on. Drawn programs have none.
  void show_lines_of(const std::string& file, std::string text) { texts_[file] = std::move(text); }

  [[nodiscard]] bool failed() const noexcept { return all_.failed(); }
  // Returns whether further errors are only counted.
  [[nodiscard]] bool full() const noexcept { return all_.full(); }
  [[nodiscard]] std::size_t errors() const noexcept { return all_.errors(); }

  // Returns all messages, files in the order of their first message, lines ascending.
  [[nodiscard]] std::vector<base::Diagnostic> list() const;

 private:
  static constexpr std::size_t kLimit = 100;
  void add(base::Diagnostic::Severity severity, const Place& at, std::string text);

  [[nodiscard]] std::string picture(const Place& at) const;

  std::vector<base::Diagnostic> found_;
  base::Diagnostics all_{{}, found_, kLimit};
  std::map<std::string, std::string> texts_;
};

}  // namespace indurop::plc
