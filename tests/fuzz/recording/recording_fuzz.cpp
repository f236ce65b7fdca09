// SPDX-License-Identifier: Apache-2.0
// Whatever bytes a recording holds: it is read to its end, or refused; messages come in the order of time, nothing
// beyond the sizes that records.h allows is reserved, and numbers are found in messages or not.

#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "history/recording/idl_layout.h"
#include "history/recording/idl_type.h"
#include "history/recording/mcap_reader.h"

namespace {

using namespace indurop::recording;

// By channel.
using Layouts = std::map<std::uint16_t, std::vector<IdlLeaf>>;

Layouts layouts_of(const Contents& contents) {
  Layouts layouts;
  for (const auto& [id, channel] : contents.channels) {
    const auto schema = contents.schemas.find(channel.schema);
    if (schema == contents.schemas.end()) {
      continue;
    }
    if (const auto type = idl_type(schema->second.data, schema->second.name); type && type->size() > kMaxMessageBytes) {
      std::abort();
    }
    if (auto layout = idl_layout(schema->second.data, schema->second.name)) {
      if (layout->size() > kMaxLeaves) {
        std::abort();
      }
      layouts.emplace(id, *std::move(layout));
    }
  }
  return layouts;
}

void read_all(McapReader& reader) {
  const Layouts layouts = layouts_of(reader.contents());
  std::vector<double> values;
  std::uint64_t before = 0;
  // Each error passes over a segment or a message, of which a file has no more than bytes when not compressed.
  while (true) {
    const auto next = reader.next();
    if (!next) {
      continue;
    }
    if (!*next) {
      return;
    }
    if ((*next)->log_time_ns < before) {
      std::abort();
    }
    before = (*next)->log_time_ns;
    if (const auto layout = layouts.find((*next)->channel); layout != layouts.end()) {
      (void)read_leaves(layout->second, (*next)->data.view, values);
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const int file = ::memfd_create("recording", MFD_CLOEXEC);
  if (file < 0 || ::write(file, data, size) != static_cast<ssize_t>(size)) {
    std::abort();
  }
  if (auto reader = McapReader::open("/proc/self/fd/" + std::to_string(file))) {
    read_all(*reader);
    reader->seek(1);
    read_all(*reader);
    for (const McapAttachmentIndex& each : reader->contents().attachments) {
      (void)reader->attachment(each);
    }
    for (const McapMetadataIndex& each : reader->contents().metadata) {
      (void)reader->metadata(each);
    }
  }
  ::close(file);
  return 0;
}
