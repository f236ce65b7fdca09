// SPDX-License-Identifier: Apache-2.0
#include "history/recorder/join.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "history/recorder/copy.h"
#include "history/recorder/run_words.h"
#include "history/recorder/sources.h"
#include "history/recording/mcap_reader.h"
#include "history/recording/mcap_writer.h"

namespace indurop::recorder {
namespace {

using base::Problem;

struct Part {
  std::string file;
  recording::McapReader reader;
  Sources sources;
  std::vector<std::string> names;
  ChannelMap channels;
};

// A recording, possibly in parts, which are read one after the other.
struct Chain {
  std::string prefix;  // topic prefix, if it is of one node
  std::vector<Part> parts;
  std::size_t at = 0;
  std::optional<recording::McapMessage> message;  // the next one
  std::uint64_t part_begin_ns = 0;                // log time of the first message of its part
  std::uint64_t end_ns = 0;                       // log time of the last message before its part
  std::map<std::pair<std::size_t, std::uint32_t>, std::pair<std::uint64_t, std::size_t>>
      last;  // run of a module, its part
};

bool simulated(const Part& part) {
  return part.sources.all.front().number("real_minus_node_ns") == 0;
}

// Virtual time is common to the boards of one plant; for a single node, or another plant, only its start is the same.
bool share_virtual_time(const Part& a, const Part& b) {
  const Source& one = a.sources.all.front();
  const Source& other = b.sources.all.front();
  return !one.text("board").empty() && !other.text("board").empty() && one.text("config") == other.text("config");
}

// Returns the number of a part; 0 for a part of an older release.
std::int64_t part_number(const Part& part) {
  return part.sources.all.front().number(kPartText);
}

// The metadata of a node is the same in all parts, including its start time to the nanosecond.
bool said_alike(const Source& one, const Source& other) {
  recording::TextMap about = one.about;
  if (const auto part = other.about.find(kPartText); part != other.about.end()) {
    about[kPartText] = part->second;
  }
  return about == other.about;
}

bool of_one_recording(const Part& a, const Part& b) {
  return !simulated(a) && a.names == b.names &&
         std::equal(a.sources.all.begin(), a.sources.all.end(), b.sources.all.begin(), b.sources.all.end(),
                    &said_alike);
}

Problem two_of_one(const std::string& file, const std::string& name) {
  return {fmt::format("{} is of {}, as another of the files: join one of each, or parts of one recording", file, name)};
}

// Returns false if a run occurred before: these are no parts of one recording.
bool goes_on(Chain& chain) {
  const Part& part = chain.parts[chain.at];
  const auto place = part.sources.channels.find(chain.message->channel);
  if (chain.parts.size() == 1 || place == part.sources.channels.end() || place->second.kind != ChannelKind::Run) {
    return true;
  }
  const auto run = run_from_cdr(chain.message->data.view);
  if (!run) {
    return true;
  }
  auto& [number, where] = chain.last[{place->second.source, run->module}];
  const bool later = where == chain.at + 1 || where == 0 || run->tail.number > number;
  number = std::max(number, run->tail.number);
  where = chain.at + 1;
  return later;
}

Result<void, Problem> advance(Chain& chain) {
  for (; chain.at < chain.parts.size(); ++chain.at) {
    const bool is_first = !chain.message;
    auto next = chain.parts[chain.at].reader.next();
    if (!next) {
      return std::move(next).error();
    }
    if (!*next && chain.message) {
      chain.end_ns = std::max(chain.end_ns, chain.message->log_time_ns);
    }
    chain.message = *std::move(next);
    if (chain.message) {
      chain.part_begin_ns = is_first ? chain.message->log_time_ns : chain.part_begin_ns;
      return goes_on(chain) ? Result<void, Problem>()
                            : two_of_one(chain.parts[chain.at].file, chain.parts[chain.at].names.front());
    }
  }
  return {};
}

Result<Part, Problem> open(const std::filesystem::path& file) {
  auto reader = recording::McapReader::open(file);
  if (!reader) {
    return std::move(reader).error();
  }
  Sources sources = find_sources(*reader);
  if (sources.all.empty()) {
    return Problem{fmt::format("{} is not a recording of indurop record or run --record", file.string())};
  }
  Part part{file.string(), std::move(reader).value(), std::move(sources), {}, {}};
  for (const Source& source : part.sources.all) {
    const std::string board = source.text("board");
    part.names.push_back(!source.prefix.empty() ? source.name() : board.empty() ? source.text("node") : board);
  }
  return part;
}

// A part begins with the known values, at the time of its first keyframe, for example. In the part before it, other
// modules may have run since then: the values follow these runs.
std::uint64_t log_time_of(const Chain& chain) {
  const recording::McapMessage& message = *chain.message;
  if (chain.at == 0 || message.log_time_ns != chain.part_begin_ns) {
    return message.log_time_ns;
  }
  const auto& channels = chain.parts[chain.at].sources.channels;
  const auto place = channels.find(message.channel);
  const bool is_value = place != channels.end() && place->second.kind == ChannelKind::Value;
  return is_value ? std::max(message.log_time_ns, chain.end_ns) : message.log_time_ns;
}

Result<void, Problem> copy_messages(std::vector<Chain>& chains, recording::McapWriter& writer, Joined& joined) {
  for (;;) {
    Chain* first = nullptr;
    for (Chain& chain : chains) {
      if (chain.message && (first == nullptr || log_time_of(chain) < log_time_of(*first))) {
        first = &chain;
      }
    }
    if (first == nullptr) {
      return writer.close();
    }
    const recording::McapMessage& message = *first->message;
    if (auto written = writer.write(first->parts[first->at].channels[message.channel], log_time_of(*first),
                                    message.publish_time_ns, message.sequence, message.data.view);
        !written) {
      return written;
    }
    ++joined.messages;
    if (auto advanced = advance(*first); !advanced) {
      return advanced;
    }
  }
}

// Adds the part to the chain that it belongs to, or as a new chain.
Result<void, Problem> sort_in(Part part, std::vector<Chain>& chains, Joined& joined) {
  for (Chain& chain : chains) {
    const Part& other = chain.parts.front();
    if (simulated(part) != simulated(other)) {
      return Problem{fmt::format("{} is of a simulation, {} is not: they have no common time",
                                 simulated(part) ? part.file : other.file, simulated(part) ? other.file : part.file)};
    }
    if (simulated(part) && part.names != other.names && !share_virtual_time(part, other)) {
      return Problem{
          fmt::format("{} and {} are two simulations, not boards of one plant: their times begin at the same value, "
                      "but are not common; simulate them as boards of a plant, or examine each on its own",
                      other.file, part.file)};
    }
    if (of_one_recording(part, other)) {
      chain.parts.push_back(std::move(part));
      return {};
    }
  }
  for (const std::string& name : part.names) {
    if (std::find(joined.names.begin(), joined.names.end(), name) != joined.names.end()) {
      return two_of_one(part.file, name);
    }
  }
  joined.names.insert(joined.names.end(), part.names.begin(), part.names.end());
  Chain& chain = chains.emplace_back();
  chain.prefix = part.sources.all.front().prefix.empty() ? part.names.front() + "/" : "";
  chain.parts.push_back(std::move(part));
  return {};
}

Result<std::vector<Chain>, Problem> open_all(const std::vector<std::filesystem::path>& files, Joined& joined) {
  std::vector<Chain> chains;
  for (const std::filesystem::path& file : files) {
    auto part = open(file);
    if (!part) {
      return std::move(part).error();
    }
    if (auto sorted = sort_in(std::move(part).value(), chains, joined); !sorted) {
      return std::move(sorted).error();
    }
  }
  for (Chain& chain : chains) {
    // Parts begin with the known values, which may be old.
    std::stable_sort(chain.parts.begin(), chain.parts.end(), [](const Part& a, const Part& b) {
      return std::pair(part_number(a), a.reader.contents().span_ns().second) <
             std::pair(part_number(b), b.reader.contents().span_ns().second);
    });
    for (std::size_t i = 1; i < chain.parts.size(); ++i) {
      const std::int64_t missing = part_number(chain.parts[i]) - part_number(chain.parts[i - 1]) - 1;
      if (missing > 0) {
        joined.gaps.push_back(fmt::format("{} {} missing between {} and {}: what ran then is not in the recording",
                                          missing, missing == 1 ? "part is" : "parts are", chain.parts[i - 1].file,
                                          chain.parts[i].file));
      }
    }
  }
  if (chains.size() == 1 && chains.front().parts.size() > 1) {
    chains.front().prefix.clear();
  }
  return chains;
}

Result<void, Problem> copy_frames(Chain& chain, recording::McapWriter& writer) {
  KnownChannels known;
  for (Part& part : chain.parts) {
    auto channels = copy_channels(part.reader, chain.prefix, writer, known);
    if (!channels) {
      return std::move(channels).error();
    }
    part.channels = *std::move(channels);
    const bool is_last = &part == &chain.parts.back();
    if (auto versions = is_last ? Result<void, Problem>() : copy_versions(part.reader, chain.prefix, writer);
        !versions) {
      return versions;
    }
  }
  return copy_about(chain.parts.back().reader, chain.prefix, writer);
}

}  // namespace

Result<Joined, Problem> join(const std::vector<std::filesystem::path>& files, const std::filesystem::path& to) {
  Joined joined;
  auto chains = open_all(files, joined);
  if (!chains) {
    return std::move(chains).error();
  }
  auto writer = recording::McapWriter::create(to, {});
  if (!writer) {
    return std::move(writer).error();
  }
  const auto copy = [&]() -> Result<void, Problem> {
    for (Chain& chain : *chains) {
      auto done = copy_frames(chain, *writer);
      if (done) {
        done = advance(chain);
      }
      if (!done) {
        return done;
      }
    }
    return copy_messages(*chains, *writer, joined);
  };
  if (auto copied = copy(); !copied) {
    std::error_code ignored;
    std::filesystem::remove(to, ignored);
    return std::move(copied).error();
  }
  return joined;
}

}  // namespace indurop::recorder
