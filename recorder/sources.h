// SPDX-License-Identifier: Apache-2.0
// Whose runs and values a recording tells: those of one node, or of several that were joined, each with its name before
// its topics.

#pragma once

#include <indurop/result.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/problem.h"
#include "recording/mcap_reader.h"

namespace indurop::recorder {

inline constexpr const char* kNodeMetadata = "indurop.node";
inline constexpr const char* kEndMetadata = "indurop.end";
inline constexpr const char* kPartText = "part";  // of what is said of the node: the file's number, from 1

// In what a replay wrote: variables, and how many runs left another value in them than the recorded one.
inline constexpr const char* kDifferingMetadata = "indurop.differing";

struct Source {
  std::string prefix;                // of its topics: "sensor/"; empty: the file is of one node
  recording::TextMap about;          // what recorder.h says of the node
  std::vector<std::string> modules;  // names, by index

  // What it says of the node; empty and 0: nothing.
  [[nodiscard]] std::string text(const std::string& key) const;
  [[nodiscard]] std::int64_t number(const std::string& key) const;
  [[nodiscard]] std::string name() const { return prefix.empty() ? "" : prefix.substr(0, prefix.size() - 1); }
};

enum class ChannelKind : std::uint8_t { Value, Run, Clock, Told };
struct ChannelPlace {
  std::size_t source = 0;
  ChannelKind kind = ChannelKind::Value;
  std::string name;  // of the variable
};

struct Sources {
  std::vector<Source> all;                         // empty: no recording of runs
  std::map<std::uint16_t, ChannelPlace> channels;  // those that belong to one
};

// The metadata of this name that was written last; none, or damaged: empty.
recording::TextMap last_metadata(const recording::McapReader& reader, const std::string& name);

// Damaged metadata counts as none.
Sources find_sources(const recording::McapReader& reader);

// The source of this name; an empty one is that of a file of one. Errors: there is none, the names are in the message.
Result<std::size_t, base::Problem> choose_source(const Sources& sources, const std::string& name,
                                                 const std::string& file);

// "module 3", or its name.
std::string module_name(const Source& source, std::uint32_t module);

}  // namespace indurop::recorder
