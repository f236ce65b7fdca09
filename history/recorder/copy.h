// SPDX-License-Identifier: Apache-2.0
// Copies everything in a recording except its messages to another one.

#pragma once

#include <indurop/result.h>

#include <array>
#include <cstdint>
#include <map>
#include <string>

#include "core/base/problem.h"
#include "history/recording/mcap_reader.h"
#include "history/recording/mcap_writer.h"

namespace indurop::recorder {

// Maps channel numbers of the file that is read to those of the one that is written.
using ChannelMap = std::map<std::uint16_t, std::uint16_t>;

// Channels by topic and by what their bytes mean: if a module was exchanged, a variable may have got another type, and
// keyframes another form.
using KnownChannels = std::map<std::array<std::string, 3>, std::uint16_t>;

// Copies schemas and channels, with `prefix` before each topic; channels in `known` exist already, new ones are added
// to it. Errors: those of the disk.
Result<ChannelMap, base::Problem> copy_channels(const recording::McapReader& from, const std::string& prefix,
                                                recording::McapWriter& to, KnownChannels& known);
// Copies attachments and metadata, with `prefix` before their names, except the metadata about how the recording ended.
// Errors: those of the disk, or a part is damaged.
Result<void, base::Problem> copy_about(const recording::McapReader& from, const std::string& prefix,
                                       recording::McapWriter& to);
// Copies only which versions of modules' code ran: a part of a recording names those of its own runs.
Result<void, base::Problem> copy_versions(const recording::McapReader& from, const std::string& prefix,
                                          recording::McapWriter& to);
// Copies schemas, channels, attachments and metadata.
Result<ChannelMap, base::Problem> copy_frame(const recording::McapReader& from, const std::string& prefix,
                                             recording::McapWriter& to);

}  // namespace indurop::recorder
