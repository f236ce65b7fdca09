// SPDX-License-Identifier: Apache-2.0
#include "recorder/join.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "recorder/copy.h"
#include "recorder/sources.h"
#include "recording/mcap_reader.h"
#include "recording/mcap_writer.h"

namespace indurop::recorder {
namespace {

using base::Problem;

struct Part {
  recording::McapReader reader;
  std::string name;
  ChannelMap channels;
  std::optional<recording::McapMessage> message;  // the next one
};

Result<std::string, Problem> name_of(const recording::McapReader& reader, const std::filesystem::path& file) {
  const auto& all = reader.contents().metadata;
  const auto found = std::find_if(all.begin(), all.end(), [](const auto& one) { return one.name == kNodeMetadata; });
  if (found == all.end()) {
    return Problem{fmt::format("{} is no recording of indurop record or run --record", file.string())};
  }
  auto metadata = reader.metadata(*found);
  if (!metadata) {
    return std::move(metadata).error();
  }
  const std::string board = metadata->values["board"];
  return board.empty() ? metadata->values["node"] : board;
}

Result<void, Problem> advance(Part& source) {
  auto next = source.reader.next();
  if (!next) {
    return std::move(next).error();
  }
  source.message = *std::move(next);
  return {};
}

Result<Part, Problem> open(const std::filesystem::path& file) {
  auto reader = recording::McapReader::open(file);
  if (!reader) {
    return std::move(reader).error();
  }
  auto name = name_of(*reader, file);
  if (!name) {
    return std::move(name).error();
  }
  return Part{std::move(reader).value(), *std::move(name), {}, std::nullopt};
}

Result<void, Problem> copy_messages(std::vector<Part>& sources, recording::McapWriter& writer, Joined& joined) {
  for (;;) {
    Part* first = nullptr;
    for (Part& source : sources) {
      if (source.message && (first == nullptr || source.message->log_time_ns < first->message->log_time_ns)) {
        first = &source;
      }
    }
    if (first == nullptr) {
      return writer.close();
    }
    const recording::McapMessage& message = *first->message;
    if (auto written = writer.write(first->channels[message.channel], message.log_time_ns, message.publish_time_ns,
                                    message.sequence, message.data.view);
        !written) {
      return written;
    }
    ++joined.messages;
    if (auto advanced = advance(*first); !advanced) {
      return advanced;
    }
  }
}

Result<std::vector<Part>, Problem> open_all(const std::vector<std::filesystem::path>& files, Joined& joined) {
  std::vector<Part> sources;
  for (const std::filesystem::path& file : files) {
    auto source = open(file);
    if (!source) {
      return std::move(source).error();
    }
    if (std::find(joined.names.begin(), joined.names.end(), source->name) != joined.names.end()) {
      return Problem{
          fmt::format("{} is of {}, as another of the files: join one of each", file.string(), source->name)};
    }
    joined.names.push_back(source->name);
    sources.push_back(std::move(source).value());
  }
  return sources;
}

}  // namespace

Result<Joined, Problem> join(const std::vector<std::filesystem::path>& files, const std::filesystem::path& to) {
  Joined joined;
  auto sources = open_all(files, joined);
  if (!sources) {
    return std::move(sources).error();
  }
  auto writer = recording::McapWriter::create(to, {});
  if (!writer) {
    return std::move(writer).error();
  }
  const auto copy = [&]() -> Result<void, Problem> {
    for (Part& source : *sources) {
      auto channels = copy_frame(source.reader, source.name + "/", *writer);
      if (!channels) {
        return std::move(channels).error();
      }
      source.channels = *std::move(channels);
      if (auto advanced = advance(source); !advanced) {
        return advanced;
      }
    }
    return copy_messages(*sources, *writer, joined);
  };
  if (auto copied = copy(); !copied) {
    std::error_code ignored;
    std::filesystem::remove(to, ignored);
    return std::move(copied).error();
  }
  return joined;
}

}  // namespace indurop::recorder
