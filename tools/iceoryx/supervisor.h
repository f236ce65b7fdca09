// SPDX-License-Identifier: Apache-2.0
// Keeps one publishing process alive: waits for RouDi, starts the process, ends it when RouDi is gone and starts it
// again when it died or hung. Never calls iceoryx itself, so it cannot hang.

#pragma once

#include "tools/values/watch_source.h"

namespace indurop::iceoryx {

// Runs until a signal asks to stop or publishing is hopeless. Returns the exit code.
int supervise(tools::Context& context, tools::WatchSource& source, int hz);

}  // namespace indurop::iceoryx
