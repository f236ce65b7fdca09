// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/recordings/recording_play.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/rt/clock.h"
#include "history/recorder/run_words.h"
#include "history/recorder/sources.h"
#include "history/recording/cdr.h"
#include "history/recording/mcap_reader.h"
#include "history/recording/omg_idl.h"
#include "store/operate/set.h"
#include "tools/cli/values/forcing.h"
#include "tools/client/node/known_uses.h"
#include "tools/client/node/node_choice.h"
#include "tools/client/process/interrupt.h"
#include "tools/console/diagnostics.h"

namespace indurop::tools {
namespace {

using base::Problem;

struct RecordingPlayOptions {
  std::filesystem::path file;
  std::vector<std::string> names;
  std::string board;
  double speed = 1;
};

// A variable that is written.
struct Played {
  const vars::DirectoryEntry* entry = nullptr;
  const schema::Variable* variable = nullptr;
  std::vector<std::uint8_t> bytes;  // written last
};
using Playlist = std::map<std::uint16_t, Played>;

bool named(const RecordingPlayOptions& options, const std::string& name) {
  return std::any_of(options.names.begin(), options.names.end(),
                     [&name](const std::string& glob) { return schema::glob_match(glob, name); });
}

// Chooses the variables that modules of the node do not write themselves, or those named on the command line.
Result<Playlist, Failure> choose(Context& context, const RecordingPlayOptions& options,
                                 const recording::McapReader& reader, const vars::Store& store) {
  const recorder::Sources sources = recorder::find_sources(reader);
  const auto source = recorder::choose_source(sources, options.board, options.file.string());
  if (!source) {
    return Failure{kFailed, source.error().text};
  }
  const KnownUses uses = known_uses(context.node);
  Playlist list;
  std::size_t written = 0;
  for (const auto& [id, place] : sources.channels) {
    const auto* entry = store.find(abi::fnv1a64(place.name.data(), place.name.size()));
    if (place.source != *source || place.kind != recorder::ChannelKind::Value || entry == nullptr ||
        (!options.names.empty() && !named(options, place.name))) {
      continue;
    }
    const schema::Variable& variable = store.schema().variables[entry->schema_index];
    const auto& channel = reader.contents().channels.at(id);
    const auto schema = reader.contents().schemas.find(channel.schema);
    if (schema == reader.contents().schemas.end() || schema->second.data != recording::omg_idl(variable.type).text) {
      return Failure{kSchemaMismatch, fmt::format("{} has another type in node {} than in {}", place.name, context.node,
                                                  options.file.string())};
    }
    const auto use = uses.find(place.name);
    if (options.names.empty() && use != uses.end() && !use->second.writers.empty()) {
      ++written;
      continue;
    }
    list[id] = {entry, &variable, {}};
  }
  if (list.empty()) {
    return Failure{kFailed,
                   written > 0 ? "modules of the node write all of these variables themselves; name those to be written"
                               : "none of the recorded variables is in the node"};
  }
  return list;
}

// Returns the names of forced variables, because writing to them has no effect; empty: none is forced.
std::vector<std::string> forced_of(const Playlist& list, const vars::Store& store) {
  std::vector<std::string> names;
  const std::vector<vars::Force> forces = store.forces();
  for (const auto& [id, played] : list) {
    if (std::any_of(forces.begin(), forces.end(),
                    [entry = played.entry](const vars::Force& force) { return force.variable == entry; })) {
      names.push_back(played.variable->name);
    }
  }
  return names;
}

struct Done {
  std::uint64_t written = 0;
  std::uint64_t refused = 0;
};

// Writes the parts that differ from the last written value.
void play_one(Played& played, std::span<const std::uint8_t> cdr, vars::Store& store, Done& done) {
  std::vector<std::uint8_t> bytes(played.entry->value_size);
  if (!recording::from_cdr(played.variable->type, cdr, bytes) || bytes == played.bytes) {
    return;
  }
  const bool ok = store.write(*played.entry, 0, bytes).ok();
  ++(ok ? done.written : done.refused);
  played.bytes = std::move(bytes);
}

Result<Done, Problem> play_all(const RecordingPlayOptions& options, recording::McapReader& reader, vars::Store& store,
                               Playlist& list) {
  Done done;
  std::optional<std::uint64_t> first;
  const std::int64_t begin = rt::now_ns();
  while (!interrupted() && !store.retired()) {
    auto message = reader.next();
    if (!message) {
      return std::move(message).error();
    }
    if (!*message) {
      break;
    }
    const auto played = list.find((*message)->channel);
    if (played == list.end()) {
      continue;
    }
    first = first ? first : (*message)->log_time_ns;
    const auto since = static_cast<double>((*message)->log_time_ns - *first) / options.speed;
    if (const std::int64_t due = begin + static_cast<std::int64_t>(since); due > rt::now_ns()) {
      wait_until(due);
    }
    if (!interrupted()) {
      play_one(played->second, (*message)->data.view, store, done);
    }
  }
  return done;
}

int play(Context& context, const RecordingPlayOptions& options) {
  auto reader = recording::McapReader::open(options.file);
  if (!reader) {
    context.out.error(reader.error().text);
    return kFailed;
  }
  auto store = open_store(context, vars::Mode::ReadWrite);
  if (!store) {
    return report(context.out, store.error());
  }
  if (const std::string absence = context.values->absence(&*store); !absence.empty()) {
    context.out.error(context.values->gone(absence));
    return kFailed;
  }
  if (!may(context, context.node, vars::Act::Set)) {
    return kFailed;
  }
  auto list = choose(context, options, *reader, *store);
  if (!list) {
    return report(context.out, list.error());
  }
  if (const auto forced = forced_of(*list, *store); !forced.empty()) {
    for (const std::string& name : forced) {
      context.out.error(operate::is_forced(name));
    }
    return kFailed;
  }
  const auto done = play_all(options, *reader, *store, *list);
  if (!done) {
    context.out.error(done.error().text);
    return kFailed;
  }
  context.out.note(fmt::format("wrote {} of {}", counted(done->written, "value"), counted(list->size(), "variable")));
  if (done->refused > 0) {
    context.out.error(fmt::format(
        "{} values could not be written: another process held the write lock of their variables", done->refused));
  }
  const auto forced = forced_of(*list, *store);
  if (!forced.empty()) {
    context.out.error(
        fmt::format("{}: forced meanwhile, not all that was written had an effect", fmt::join(forced, ", ")));
  }
  return done->refused > 0 || !forced.empty() ? kFailed : kOk;
}

}  // namespace

void add_recording_play(base::Options& app, Context& context, const std::shared_ptr<Action>& chosen) {
  constexpr double kMinSpeed = 0.001;
  constexpr double kMaxSpeed = 1000;
  auto options = std::make_shared<RecordingPlayOptions>();
  base::Options& verb =
      app.command("play", "Write recorded values into a running node at their recorded times",
                  [options, chosen] { *chosen = [options](Context& c) { return play(c, *options); }; });
  verb.add("file", "FILE.mcap", options->file, "The recording").required().completes(base::Completion::File);
  verb.add("names", "GLOB", options->names, "Variables, or globs; none: those that no module of the node writes");
  verb.add("--board", "NAME", options->board, "Board whose values are written, if the recording has several");
  verb.add("--speed", "N", options->speed, "Speed as a multiple of the recorded speed (default: 1)")
      .range(kMinSpeed, kMaxSpeed);
  add_node_option(verb, context);
  verb.details(
      "Feeds recorded inputs to the current modules: variables that no module of the node writes get their recorded\n"
      "values at the recorded times. A module that writes a named variable overwrites it in its next run. To repeat\n"
      "runs exactly, see indurop replay.\n");
}

}  // namespace indurop::tools
