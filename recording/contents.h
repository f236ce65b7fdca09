// SPDX-License-Identifier: Apache-2.0
// What is where in a recording: from its summary, or, where it has none or a damaged one, from a walk over all records.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "base/problem.h"
#include "recording/input_file.h"
#include "recording/records.h"
#include "recording/segment.h"

namespace indurop::recording {

struct Contents {
  McapHeader header;
  std::map<std::uint16_t, McapSchema> schemas;
  std::map<std::uint16_t, McapChannel> channels;
  std::vector<Segment> segments;  // in the order of the file
  std::vector<McapAttachmentIndex> attachments;
  std::vector<McapMetadataIndex> metadata;
  bool has_summary = false;            // one that names all; what was not closed has none
  std::vector<base::Problem> damages;  // what was passed over, each with its place

  // Log times of the first and the last message; 0 and 0: there is none.
  [[nodiscard]] std::pair<std::int64_t, std::int64_t> span_ns() const;
  // The first schema or channel of a number counts. False if this is another one.
  bool add(McapSchema schema);
  bool add(McapChannel channel);
};

// Errors: no MCAP file, or not even its header is whole.
Result<Contents, base::Problem> read_contents(const InputFile& file);

// Inside contents: the records from byte `begin` to the end of the data.
void walk(const InputFile& file, std::uint64_t begin, Contents& contents);

}  // namespace indurop::recording
