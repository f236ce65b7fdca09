// SPDX-License-Identifier: Apache-2.0
// Exit codes of all programs: the only list. Help texts and man pages are made from kExitCodes, and docs/cli.md is
// compared with it. A program returns a code of this list, or that of the program it started (indurop run, indurop plc
// build).

#pragma once

#include <array>
#include <string_view>

namespace indurop {

inline constexpr int kOk = 0;
inline constexpr int kFailed = 1;
inline constexpr int kUsage = 2;
inline constexpr int kCheckFailed = 4;
inline constexpr int kRolledBack = 5;
inline constexpr int kUnreachable = 6;
inline constexpr int kNoRealTime = 7;
inline constexpr int kSchemaMismatch = 8;
inline constexpr int kInterrupted = 130;  // 128 + SIGINT, as in shells
inline constexpr int kTerminated = 143;   // 128 + SIGTERM

struct ExitCode {
  int value;
  std::string_view name;  // one word, for programs that name codes
  std::string_view text;  // one line for users
};

// Sorted by value. A number in use never changes its meaning.
inline constexpr std::array kExitCodes{
    ExitCode{kOk, "ok", "ok"},
    ExitCode{kFailed, "failed", "failed: the message says why"},
    ExitCode{kUsage, "usage", "wrong usage"},
    ExitCode{kCheckFailed, "check-failed", "check found errors"},
    ExitCode{kRolledBack, "rolled-back", "deployed and rolled back"},
    ExitCode{kUnreachable, "unreachable", "node or board not there, or time-out"},
    ExitCode{kNoRealTime, "no-real-time", "real-time privileges not obtained with --require-rt"},
    ExitCode{kSchemaMismatch, "schema-mismatch", "layouts differ: another version, or a variable of another type"},
    ExitCode{kInterrupted, "interrupted", "interrupted (Ctrl-C)"},
    ExitCode{kTerminated, "terminated", "ended by SIGTERM; a node or agent ends with 0"},
};

}  // namespace indurop
