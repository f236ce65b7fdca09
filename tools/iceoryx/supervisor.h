// SPDX-License-Identifier: Apache-2.0
// Keeps one publishing process running: waits for RouDi, starts the process, ends it when RouDi is gone and restarts it
// when it died or hung. Never calls iceoryx itself, so it cannot hang.

#pragma once

#include "tools/client/values/watch_source.h"
#include "tools/console/context.h"

namespace indurop::iceoryx {

// Runs until a signal requests the end or publishing is impossible. Returns the exit code.
int supervise(tools::Context& context, tools::WatchSource& source, int hz);

}  // namespace indurop::iceoryx
