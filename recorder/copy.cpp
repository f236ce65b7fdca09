// SPDX-License-Identifier: Apache-2.0
#include "recorder/copy.h"

#include <utility>

#include "recorder/sources.h"

namespace indurop::recorder {
namespace {

using base::Problem;

Result<void, Problem> copy_attachments(const recording::McapReader& from, const std::string& prefix,
                                       recording::McapWriter& to) {
  for (const recording::McapAttachmentIndex& index : from.contents().attachments) {
    const auto bytes = from.attachment(index);
    if (!bytes) {
      return bytes.error();
    }
    recording::McapAttachment attachment;
    attachment.name = prefix + index.name;
    attachment.media_type = index.media_type;
    if (auto attached = to.attach(attachment, *bytes); !attached) {
      return attached;
    }
  }
  return {};
}

Result<void, Problem> copy_metadata(const recording::McapReader& from, const std::string& prefix,
                                    recording::McapWriter& to) {
  for (const recording::McapMetadataIndex& index : from.contents().metadata) {
    if (index.name.ends_with(kEndMetadata)) {
      continue;
    }
    const auto metadata = from.metadata(index);
    if (!metadata) {
      return metadata.error();
    }
    if (auto said = to.metadata(prefix + index.name, metadata->values); !said) {
      return said;
    }
  }
  return {};
}

}  // namespace

Result<ChannelMap, Problem> copy_frame(const recording::McapReader& from, const std::string& prefix,
                                       recording::McapWriter& to) {
  ChannelMap channels;
  std::map<std::uint16_t, std::uint16_t> schemas{{std::uint16_t{0}, std::uint16_t{0}}};
  for (const auto& [id, schema] : from.contents().schemas) {
    auto added = to.add_schema(schema.name, schema.encoding, schema.data);
    if (!added) {
      return std::move(added).error();
    }
    schemas[id] = *added;
  }
  for (const auto& [id, channel] : from.contents().channels) {
    auto added = to.add_channel(schemas[channel.schema], prefix + channel.topic, channel.encoding, channel.metadata);
    if (!added) {
      return std::move(added).error();
    }
    channels[id] = *added;
  }
  if (auto attached = copy_attachments(from, prefix, to); !attached) {
    return std::move(attached).error();
  }
  if (auto said = copy_metadata(from, prefix, to); !said) {
    return std::move(said).error();
  }
  return channels;
}

}  // namespace indurop::recorder
