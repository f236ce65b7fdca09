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
  std::vector<std::string> names;
  std::string prefix;  // of its topics, if it is of one
  ChannelMap channels;
  std::optional<recording::McapMessage> message;  // the next one
};

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
  const Sources sources = find_sources(*reader);
  if (sources.all.empty()) {
    return Problem{fmt::format("{} is no recording of indurop record or run --record", file.string())};
  }
  Part part{std::move(reader).value(), {}, {}, {}, std::nullopt};
  for (const Source& source : sources.all) {
    const std::string board = source.text("board");
    part.names.push_back(!source.prefix.empty() ? source.name() : board.empty() ? source.text("node") : board);
    part.prefix = source.prefix.empty() ? part.names.back() + "/" : "";
  }
  return part;
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
    for (const std::string& name : source->names) {
      if (std::find(joined.names.begin(), joined.names.end(), name) != joined.names.end()) {
        return Problem{fmt::format("{} is of {}, as another of the files: join one of each", file.string(), name)};
      }
      joined.names.push_back(name);
    }
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
      auto channels = copy_frame(source.reader, source.prefix, *writer);
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
