// SPDX-License-Identifier: Apache-2.0
#include "history/recorder/copy.h"

#include <utility>

#include "history/recorder/run_words.h"
#include "history/recorder/sources.h"
#include "history/recorder/versions.h"

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

// `wanted`: by name.
Result<void, Problem> copy_metadata(const recording::McapReader& from, const std::string& prefix,
                                    recording::McapWriter& to, bool (*wanted)(const std::string& name)) {
  for (const recording::McapMetadataIndex& index : from.contents().metadata) {
    if (!wanted(index.name)) {
      continue;
    }
    const auto metadata = from.metadata(index);
    if (!metadata) {
      return metadata.error();
    }
    if (auto metadata_values = to.metadata(prefix + index.name, metadata->values); !metadata_values) {
      return metadata_values;
    }
  }
  return {};
}

}  // namespace

Result<ChannelMap, Problem> copy_channels(const recording::McapReader& from, const std::string& prefix,
                                          recording::McapWriter& to, KnownChannels& known) {
  ChannelMap channels;
  std::map<std::uint16_t, std::uint16_t> schemas{{std::uint16_t{0}, std::uint16_t{0}}};
  for (const auto& [id, channel] : from.contents().channels) {
    const std::string topic = prefix + channel.topic;
    const auto schema = from.contents().schemas.find(channel.schema);
    const auto form = channel.metadata.find(kKeyframeForm);
    const std::array<std::string, 3> key{topic, schema == from.contents().schemas.end() ? "" : schema->second.data,
                                         form == channel.metadata.end() ? "" : form->second};
    if (const auto same = known.find(key); same != known.end()) {
      channels[id] = same->second;
      continue;
    }
    if (schema != from.contents().schemas.end() && !schemas.contains(channel.schema)) {
      auto added = to.add_schema(schema->second.name, schema->second.encoding, schema->second.data);
      if (!added) {
        return std::move(added).error();
      }
      schemas[channel.schema] = *added;
    }
    auto added = to.add_channel(schemas[channel.schema], topic, channel.encoding, channel.metadata);
    if (!added) {
      return std::move(added).error();
    }
    channels[id] = known[key] = *added;
  }
  return channels;
}

Result<void, Problem> copy_about(const recording::McapReader& from, const std::string& prefix,
                                 recording::McapWriter& to) {
  auto attached = copy_attachments(from, prefix, to);
  return attached
             ? copy_metadata(from, prefix, to, [](const std::string& name) { return !name.ends_with(kEndMetadata); })
             : attached;
}

Result<void, Problem> copy_versions(const recording::McapReader& from, const std::string& prefix,
                                    recording::McapWriter& to) {
  return copy_metadata(from, prefix, to, [](const std::string& name) { return name.ends_with(kVersionMetadata); });
}

Result<ChannelMap, Problem> copy_frame(const recording::McapReader& from, const std::string& prefix,
                                       recording::McapWriter& to) {
  KnownChannels known;
  auto channels = copy_channels(from, prefix, to, known);
  if (!channels) {
    return channels;
  }
  if (auto about = copy_about(from, prefix, to); !about) {
    return std::move(about).error();
  }
  return channels;
}

}  // namespace indurop::recorder
