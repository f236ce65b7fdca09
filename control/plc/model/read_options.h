// SPDX-License-Identifier: Apache-2.0
// Options for the readers of PLC programs.

#pragma once

namespace indurop::plc {

struct ReadOptions {
  bool watch = false;      // drawn programs report their power flow to a running view
  bool in_editor = false;  // texts of CODESYS, where END_PROGRAM and so on may be missing at the end
};

}  // namespace indurop::plc
