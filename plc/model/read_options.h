// SPDX-License-Identifier: Apache-2.0
// What can be asked of a reader of PLC programs.

#pragma once

namespace indurop::plc {

struct ReadOptions {
  bool watch = false;      // programs that are drawn tell a running view about their power flow
  bool in_editor = false;  // texts of CODESYS, in which END_PROGRAM and so on may miss at the end
};

}  // namespace indurop::plc
