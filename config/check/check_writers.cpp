// SPDX-License-Identifier: Apache-2.0
// Reports variables with too many or too few users.

#include <algorithm>

#include "config/check/check_parts.h"
#include "core/base/text.h"

namespace indurop::config {
namespace {

void check_writers_of_one_board(const std::string& name, const Users& users, const Uses& uses,
                                base::Diagnostics& report) {
  std::map<std::size_t, std::vector<User>> by_board;
  for (const User& writer : users.writers) {
    by_board[writer.board].push_back(writer);
  }
  for (const auto& [board, writers] : by_board) {
    if (writers.size() > 1) {
      report.warning(uses.module(writers[1]).places.file,
                     base::in_quotes(name) + " is written by " + base::enumerate(uses.names(writers)) +
                         "; where both write the same part, the one that runs later wins: let one module own it");
    }
  }
}

void check_never_written(const std::string& name, const Users& users, const Uses& uses, base::Diagnostics& report) {
  const base::SourcePlace place = uses.module(users.readers.front()).places.file;
  const std::string text =
      base::in_quotes(name) + " is read by " + base::enumerate(uses.names(users.readers)) + " but ";
  if (users.given) {
    report.note(place, text + "no module writes it: a parameter, with the value of its declaration unless set by hand");
    return;
  }
  if (uses.unknown_writers().empty()) {
    report.warning(place, text + "no module writes it; it keeps its initial value unless set by hand");
    return;
  }
  const std::string hint =
      text + "no module is known to write it; perhaps " + base::enumerate(uses.names(uses.unknown_writers())) + " does";
  for (const User& reader : users.readers) {
    for (const User& writer : uses.unknown_writers()) {
      if (reader.board != writer.board) {
        report.warning(place, hint + ": name it there in <access><write>, else the value stays on its board");
        return;
      }
    }
  }
  report.note(place, hint);
}

}  // namespace

void check_writers(const Uses& uses, const std::set<std::string>& set_by_hand, base::Diagnostics& report) {
  for (const auto& [name, users] : uses.variables()) {
    check_writers_of_one_board(name, users, uses, report);
    if (users.writers.empty() && !users.readers.empty() && !users.optional && !set_by_hand.contains(name)) {
      check_never_written(name, users, uses, report);
    }
    if (users.readers.empty() && uses.unknown_readers().empty()) {
      report.note(uses.module(users.writers.front()).places.file, base::in_quotes(name) + " is written by " +
                                                                      base::enumerate(uses.names(users.writers)) +
                                                                      " but no module reads it");
    }
  }
}

}  // namespace indurop::config
