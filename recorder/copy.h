// SPDX-License-Identifier: Apache-2.0
// What stands around the messages of a recording, taken over to another one.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <map>
#include <string>

#include "base/problem.h"
#include "recording/mcap_reader.h"
#include "recording/mcap_writer.h"

namespace indurop::recorder {

// By number in the file that is read, the number in the one that is written.
using ChannelMap = std::map<std::uint16_t, std::uint16_t>;

// Schemas, channels, attachments and metadata, all names with `prefix` in front; what says how the recording ended is
// left out. Errors: those of the disk, or a part is damaged.
Result<ChannelMap, base::Problem> copy_frame(const recording::McapReader& from, const std::string& prefix,
                                             recording::McapWriter& to);

}  // namespace indurop::recorder
