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

// Schemas and channels, topics with `prefix` in front; those of `topics` are there already, new ones are added to it.
// Errors: those of the disk.
Result<ChannelMap, base::Problem> copy_channels(const recording::McapReader& from, const std::string& prefix,
                                                recording::McapWriter& to,
                                                std::map<std::string, std::uint16_t>& topics);
// Attachments and metadata, so named; what says how the recording ended is left out. Errors: those of the disk, or a
// part is damaged.
Result<void, base::Problem> copy_about(const recording::McapReader& from, const std::string& prefix,
                                       recording::McapWriter& to);
// All of it.
Result<ChannelMap, base::Problem> copy_frame(const recording::McapReader& from, const std::string& prefix,
                                             recording::McapWriter& to);

}  // namespace indurop::recorder
