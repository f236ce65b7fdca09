// SPDX-License-Identifier: Apache-2.0
// The table of contents of a recording: from its summary, or, if that is missing or damaged, from a walk over all
// records.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "core/base/problem.h"
#include "history/recording/input_file.h"
#include "history/recording/records.h"
#include "history/recording/segment.h"

namespace indurop::recording {

struct Contents {
  McapHeader header;
  std::map<std::uint16_t, McapSchema> schemas;
  std::map<std::uint16_t, McapChannel> channels;
  std::vector<Segment> segments;  // in the order of the file
  std::vector<McapAttachmentIndex> attachments;
  std::vector<McapMetadataIndex> metadata;
  bool has_summary = false;            // a complete one; a file that was not closed has none
  std::vector<base::Problem> damages;  // what was skipped, each with its position

  // Returns the log times of the first and the last message; 0 and 0: there is none.
  [[nodiscard]] std::pair<std::int64_t, std::int64_t> span_ns() const;
  // The first schema or channel of a number is kept. Returns false if this is a different one.
  bool add(McapSchema schema);
  bool add(McapChannel channel);
};

// Errors: no MCAP file, or its header is incomplete.
Result<Contents, base::Problem> read_contents(const InputFile& file);

// Implementation of read_contents(): walks the records from byte `begin` to the end of the data.
void walk(const InputFile& file, std::uint64_t begin, Contents& contents);

}  // namespace indurop::recording
