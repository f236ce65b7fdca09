// SPDX-License-Identifier: Apache-2.0
// What can be asked of a reader of PLC programs.

#pragma once

namespace indurop::plc {

struct ReadOptions {
  bool watch = false;  // programs that are drawn tell a running view about their power flow
};

}  // namespace indurop::plc
