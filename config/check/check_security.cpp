// SPDX-License-Identifier: Apache-2.0
// Checks the keys of a plant, as a part of check_plant().

#include <chrono>
#include <cstdlib>

#include "config/check/plant_parts.h"
#include "core/base/text.h"
#include "core/keys/plant_keys.h"

namespace indurop::config {
namespace {

constexpr std::chrono::days kSoon{30};

// Returns the authority that the board trusts; empty if unknown.
std::string check_board(const Plant& plant, const std::string& board, bool runs_here, base::Diagnostics& report) {
  const keys::Instant now = keys::instant_now();
  const keys::KeyCheck check = keys::check_board_keys(keys_folder(plant, board), plant.name, board, now);
  if (!check.exposed.empty()) {
    report.warning(plant.security_place, check.exposed);
  }
  const std::string whose = "keys of board " + base::in_quotes(board) + ": " + check.problem;
  switch (check.fault) {
    case keys::KeyFault::None:
      if (check.validity.until < now + kSoon) {
        report.warning(plant.security_place, "the keys of board " + base::in_quotes(board) + " are valid until " +
                                                 keys::utc_text(check.validity.until) + "; indurop keys renew " +
                                                 board);
      }
      break;
    case keys::KeyFault::Missing:
      if (keys::reserved_name(board)) {
        report.error(plant.security_place, "a board of a plant with keys cannot be called " + base::in_quotes(board) +
                                               ", which is the name of a role; choose another name");
        break;
      }
      report.error(plant.security_place, whose + "; create them with indurop keys init or indurop keys add " + board +
                                             ", or copy them from the machine that created them");
      break;
    case keys::KeyFault::Wrong:
      report.error(plant.security_place, whose + "; indurop keys list shows what is there");
      break;
    case keys::KeyFault::NotNow:
      // A board continues to run its own modules; the network works again with new keys.
      if (runs_here) {
        report.warning(plant.security_place, whose + "; indurop keys renew " + board + ", or set the clock");
      } else {
        report.error(plant.security_place, whose + "; indurop keys renew " + board);
      }
      break;
    case keys::KeyFault::Outdated:
      // Older permissions also allow the traffic between boards.
      report.warning(plant.security_place, whose + ", so agents and other tools may be refused; indurop keys renew " +
                                               board + ", then copy permissions.p7s and identity.pem to the board");
      break;
  }
  return check.authority;
}

}  // namespace

std::filesystem::path keys_folder(const Plant& plant, const std::string& board) {
  if (plant.security.empty()) {
    return {};
  }
  std::error_code ignored;
  std::filesystem::path default_keys = keys::PlantKeys(plant.security).board(board);
  if (std::filesystem::exists(default_keys, ignored)) {
    return std::filesystem::absolute(default_keys, ignored).lexically_normal();
  }
  const char* named = std::getenv("INDUROP_KEYS_DIR");
  const std::filesystem::path on_board = named != nullptr && *named != '\0' ? named : "/etc/indurop/keys";
  const std::filesystem::path copied = on_board / plant.name / board;
  return std::filesystem::exists(copied, ignored) ? copied : default_keys;
}

void check_security(const Plant& plant, const CheckOptions& options, base::Diagnostics& report) {
  if (plant.security.empty()) {
    report.note(plant.security_place,
                "the plant is open: anyone in the network can read and write the boards' variables; make keys with "
                "indurop keys init, then say where they are with <security>keys</security>");
    return;
  }
  std::string first;  // authority
  for (const Board& board : plant.boards) {
    if (!options.board.empty() && options.board != board.name) {
      continue;
    }
    const std::string authority = check_board(plant, board.name, !options.board.empty(), report);
    first = first.empty() ? authority : first;
    if (!authority.empty() && authority != first) {
      report.error(
          plant.security_place,
          "the keys of board " + base::in_quotes(board.name) +
              " were issued by another authority than those of the boards above; the boards would reject each other");
    }
  }
}

}  // namespace indurop::config
