// SPDX-License-Identifier: Apache-2.0
// The nodes of a recording and their channels: one node, or several that were joined, each with its name as topic
// prefix.

#pragma once

#include <indurop/result.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "history/recording/mcap_reader.h"

namespace indurop::recorder {

inline constexpr const char* kNodeMetadata = "indurop.node";
inline constexpr const char* kEndMetadata = "indurop.end";
inline constexpr const char* kPartText = "part";  // key in the node's metadata: the file's number, from 1

// In the result of a replay: variables, with the number of runs that left a value different from the recorded one.
inline constexpr const char* kDifferingMetadata = "indurop.differing";

// A value of such texts; empty or 0 if it is missing.
std::string text_in(const recording::TextMap& texts, const std::string& key);
std::int64_t number_in(const recording::TextMap& texts, const std::string& key);

struct Source {
  std::string prefix;                // topic prefix: "sensor/"; empty: the file is of one node
  recording::TextMap about;          // description of the node (recorder.h)
  std::vector<std::string> modules;  // names, by index

  // A value of the node's metadata; empty or 0 if it is missing.
  [[nodiscard]] std::string text(const std::string& key) const;
  [[nodiscard]] std::int64_t number(const std::string& key) const;
  [[nodiscard]] std::string name() const { return prefix.empty() ? "" : prefix.substr(0, prefix.size() - 1); }
};

enum class ChannelKind : std::uint8_t { Value, Run, Clock, Answer, Keyframe };
struct ChannelPlace {
  std::size_t source = 0;
  ChannelKind kind = ChannelKind::Value;
  std::string name;  // of the variable; Keyframe: topic without prefix
};

struct Sources {
  std::vector<Source> all;                         // empty: not a recording of runs
  std::map<std::uint16_t, ChannelPlace> channels;  // channels that belong to a source
};

// Returns the metadata of this name that was written last; empty if there is none or it is damaged.
recording::TextMap last_metadata(const recording::McapReader& reader, const std::string& name);

// Damaged metadata is ignored.
Sources find_sources(const recording::McapReader& reader);

// Returns the source of this name; an empty name selects the one of a file with a single source. Errors: no such
// source, the message lists the names.
Result<std::size_t, base::Problem> choose_source(const Sources& sources, const std::string& name,
                                                 const std::string& file);

// Returns the module's name, or "module 3" if it has none.
std::string module_name(const Source& source, std::uint32_t module);

}  // namespace indurop::recorder
