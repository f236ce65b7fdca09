// SPDX-License-Identifier: Apache-2.0
#include "node/run/options.h"

#include <cstdio>
#include <cstdlib>

#include "config/xml/plant_reader.h"
#include "store/vars/node_lock.h"
#include "store/vars/shm_file.h"

namespace indurop::node {

bool simulates_plant(const Options& options) {
  return options.simulation.on && options.board.empty() && options.replay.file.empty() &&
         config::is_plant_file(options.config);
}

namespace {

// Reports options without effect, and what to do instead; empty: there are none.
std::string idle_options(const Options& options) {
  const bool replays = !options.replay.file.empty();
  if (!replays && !options.replay.board.empty()) {
    return "--replay-board is for --replay";
  }
  if (!replays && !options.replay.with.empty()) {
    return "--with is for --replay; to run another file, name it in the configuration";
  }
  if (!replays && !options.replay.output.empty()) {
    return "--replay-output is for --replay; to record a run: --record";
  }
  if (!replays && !options.replay.kept.empty()) {
    return "--replay-kept is for --replay";
  }
  if (!options.replay.report.empty() && (!replays || options.replay.with.size() != 1)) {
    return "--replay-report is for --replay and one --with";
  }
  constexpr std::uint64_t kLast = config::Replay::kLastTick;
  if (!replays &&
      (options.replay.from_tick > 0 || options.replay.to_tick != kLast || options.replay.stop_tick != kLast)) {
    return "--replay-from, --replay-to and --replay-stop-at are for --replay";
  }
  if (replays && options.duration) {
    return "a replay ends with its recording; shorten that with indurop recording cut";
  }
  const bool part = options.simulation.conductor.has_value();
  if (!part && !simulates_plant(options) &&
      !(options.simulation.network.empty() && options.simulation.script.empty())) {
    return "--network and --script are for --sim of all boards of a plant: name its manifest, and no --board";
  }
  if (options.require_rt && options.simulation.on) {
    return "--require-rt and --sim: virtual time needs no privileges; leave out one of them";
  }
  return "";
}

}  // namespace

std::optional<Options> parse_options(int argc, char** argv, int& exit_code) {
  Options options;
  if (const char* named = std::getenv("INDUROP_NODE"); named != nullptr) {
    options.node = named;
  }
  base::Options line("indurop-node",
                     "Run the modules of a module.xml, or of one board of a plant, each with its own period");
  line.version(INDUROP_VERSION);
  config::declare_run_options(line, options);
  line.flag("-q,--quiet", options.quiet, "Only warnings and errors");
  line.flag("--journal", options.journal, "Messages go to systemd's journal; errors to standard error as well");
  line.details(
      "indurop-agent --board NAME makes this host a board that indurop deploy can reach.\n"
      "indurop run PLANT --local runs all boards of a plant on this host.\n");
  line.exit_codes({kOk, kFailed, kUsage, kCheckFailed, kNoRealTime, kSchemaMismatch, kInterrupted});
  if (const auto code = line.parse_program(argc, argv)) {
    exit_code = *code;
    return std::nullopt;
  }
  exit_code = kUsage;
  if (const std::string idle = idle_options(options); !idle.empty()) {
    std::fprintf(stderr, "indurop-node: error: %s\n", idle.c_str());
    return std::nullopt;
  }
  if (!options.replay.file.empty()) {
    options.simulation.on = true;  // independent of this machine, and leaves nothing behind
    options.tape_megabytes = 0;
  }
  if (options.config.empty()) {
    std::fputs("indurop-node: error: name a module.xml or a plant's manifest with --board\n", stderr);
    return std::nullopt;
  }
  if (simulates_plant(options)) {
    return options;  // its boards have names
  }
  if (options.node.empty()) {
    options.node = options.board.empty() ? vars::default_node() : options.board;
    if (options.simulation.on) {
      options.node = options.board.empty() ? "sim" : options.board + "-sim";  // in addition to the real one
      options.node = options.replay.file.empty() ? options.node
                     : options.board.empty()     ? "replay"
                                                 : options.board + "-replay";
    } else if (const std::string owner = vars::other_owner("local");
               options.board.empty() && !owner.empty() && !options.quiet) {
      std::fprintf(stderr, "indurop-node: note: the name 'local' is in use by user %s: this node is '%s'\n",
                   owner.c_str(), options.node.c_str());
    }
  }
  if (!vars::valid_node_name(options.node)) {
    std::fprintf(
        stderr,
        "indurop-node: error: INDUROP_NODE: '%s' is not a valid node name: use 1 to 40 letters, digits, '_' or '-'\n",
        options.node.c_str());
    return std::nullopt;
  }
  return options;
}

}  // namespace indurop::node
