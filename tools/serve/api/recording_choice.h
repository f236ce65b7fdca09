// SPDX-License-Identifier: Apache-2.0
// The recording that the path of a request names.

#pragma once

#include "tools/client/recordings/recorded_file.h"
#include "tools/serve/api/api.h"
#include "tools/serve/api/router.h"

namespace indurop::serve {

// Only files that are listed can be opened, whatever the path is. Returns the reply that says so.
Result<tools::RecordingFile, Reply> recording_of(const Api& api, const Call& call);

}  // namespace indurop::serve
