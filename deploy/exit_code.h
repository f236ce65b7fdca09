// SPDX-License-Identifier: Apache-2.0
// Exit codes of the programs that run and look at nodes, as docs/cli.md has them.

#pragma once

namespace indurop {

inline constexpr int kOk = 0;
inline constexpr int kFailed = 1;
inline constexpr int kUsage = 2;
inline constexpr int kCheckFailed = 4;
inline constexpr int kUnreachable = 6;
inline constexpr int kNoRealTime = 7;
inline constexpr int kSchemaMismatch = 8;
inline constexpr int kInterrupted = 130;

}  // namespace indurop
