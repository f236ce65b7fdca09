// SPDX-License-Identifier: Apache-2.0
// indurop replay: the modules of a recording run again with what they began with, and are compared with it.
#include <fmt/format.h>

#include "recorder/sources.h"
#include "recording/mcap_reader.h"
#include "tools/command/node_program.h"
#include "tools/verbs/verbs.h"

namespace indurop::tools {
namespace {

struct Options {
  std::filesystem::path file;
  std::filesystem::path config;
  std::string node;
  std::string board;
  std::vector<std::string> with;
};

// What the recording says of the node it is of.
Result<recording::TextMap, base::Problem> about(const Options& options) {
  auto reader = recording::McapReader::open(options.file);
  if (!reader) {
    return std::move(reader).error();
  }
  const recorder::Sources sources = recorder::find_sources(*reader);
  const auto source = recorder::choose_source(sources, options.board, options.file.string());
  if (!source) {
    return source.error();
  }
  return sources.all[*source].about;
}

int replay(Context& context, const Options& options) {
  const auto program = node_program(context);
  if (program.empty()) {
    return kFailed;
  }
  auto known = about(options);
  if (!known) {
    context.out.error(known.error().text);
    return kFailed;
  }
  config::RunOptions run;
  run.quiet = context.out.quiet();
  run.replay.file = options.file;
  run.replay.board = options.board;
  run.replay.with = options.with;
  run.config = options.config.empty() ? std::filesystem::path((*known)["config"]) : options.config;
  run.board = (*known)["board"];
  run.node = options.node;
  std::error_code ignored;
  if (!std::filesystem::exists(run.config, ignored)) {
    context.out.error(fmt::format("{} was recorded with {}, which is not here; name the configuration with --config",
                                  options.file.string(), run.config.string()));
    return kFailed;
  }
  return become_node(context, program, run);
}

Action declare(base::Options& app, Context& /*context*/) {
  auto options = std::make_shared<Options>();
  app.add("file", "FILE.mcap", options->file, "The recording").required().completes(base::Completion::File);
  app.add("--config", "FILE", options->config, "module.xml or plant.xml (default: that of the recording)")
      .completes(base::Completion::File);
  app.add("--with", "FILE.so", options->with, "Use this file for the module of its name; may be given several times")
      .completes(base::Completion::File);
  app.add("--board", "NAME", options->board, "The board whose runs are meant, if the recording is of several");
  app.add("--node", "NAME", options->node, "Name of the replaying node (default: replay)");
  return [options](Context& c) { return replay(c, *options); };
}

}  // namespace

const Verb kReplayVerb{
    "replay", "Start and stop", "Run what was recorded once more, and compare",
    "Each run of the recording is repeated by the real modules, with what it began with and at its time; then what it\n"
    "leaves is compared bit by bit. Modules that speak to devices or the network do not run. Exit code 0: all is\n"
    "equal; 4: the first difference is told, with tick, module, variable, recorded and new value.\n"
    "Examples:\n"
    "  indurop run module.xml --duration 60s --record run.mcap\n"
    "  indurop replay run.mcap\n"
    "  indurop replay run.mcap --with new/main.so\n",
    &declare};

}  // namespace indurop::tools
