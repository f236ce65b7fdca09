// SPDX-License-Identifier: Apache-2.0
// How a run of the node ends. A phase that cannot continue returns it instead of its result; it has already printed its
// messages.

#pragma once

#include <indurop/result.h>

#include <optional>
#include <string>

#include "core/base/exit_code.h"
#include "core/base/stop_signal.h"

namespace indurop::node {

struct Ending {
  int code = kOk;           // exit code of the program
  std::string reason = {};  // for the run block; empty: the duration is over, or it could not start
};

// The ending that a stop signal requests, if one was received.
std::optional<Ending> interruption(base::StopSignal& signals);

// "cannot lock the file: No such file or directory"
std::string describe(const Error& error);

}  // namespace indurop::node
