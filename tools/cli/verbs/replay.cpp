// SPDX-License-Identifier: Apache-2.0
// indurop replay: runs the modules of a recording again with the recorded inputs, and compares the results.
#include "tools/cli/recordings/recording_replay.h"
#include "tools/cli/verbs/verbs.h"

namespace indurop::tools {
namespace {

Action declare_replay(base::Options& app, Context& /*context*/) {
  auto options = std::make_shared<ReplayOptions>();
  app.add("file", "FILE.mcap", options->file, "The recording").required().completes(base::Completion::File);
  app.add("--config", "FILE", options->config, "module.xml or plant.xml (default: that of the recording)")
      .completes(base::Completion::File);
  app.add("--with", "FILE.so", options->with, "Use this file for the module of its name; may be given several times")
      .completes(base::Completion::File);
  app.add("-o,--file", "FILE.mcap", options->output, "Write the values that modules write now to this MCAP file")
      .completes(base::Completion::File);
  app.add("--svg", "FILE", options->svg, "Draw the recorded and the new values that differ");
  app.add("--from", "TICK", options->from,
          "Compare the runs of this tick and later ones; begins at the keyframes before");
  app.add("--to", "TICK", options->to, "Compare the runs up to this tick");
  app.add("--at", "TICK", options->at, "Compare the runs of this tick only");
  app.add("--stop-at", "TICK", options->stop_at,
          "Stop before the runs of this tick, for a debugger; begins at the keyframes before");
  app.add("--board", "NAME", options->board, "Board to replay, if the recording has several");
  app.add("--node", "NAME", options->node, "Name of the replaying node (default: replay)");
  return [options](Context& c) { return replay_recording(c, *options); };
}

}  // namespace

const Verb kReplayVerb{
    "replay", "Start and stop", "Run a recording again and compare the results",
    "The real modules repeat each run of the recording, with its recorded inputs and time; then their outputs are\n"
    "compared with the recorded ones, bit for bit. Modules that use devices or the network do not run. Exit code\n"
    "0 if everything is equal, 4 if not: the first difference is reported with tick, module, variable, recorded\n"
    "and new value.\n"
    "Examples:\n"
    "  indurop run module.xml --duration 60s --record run.mcap\n"
    "  indurop replay run.mcap\n"
    "  indurop replay run.mcap --from 90000 --to 91000\n"
    "  indurop replay run.mcap --stop-at 90500\n"
    "  indurop replay run.mcap --with new/main.so\n"
    "  indurop replay run.mcap --with new/main.so --svg differs.svg\n",
    &declare_replay};

}  // namespace indurop::tools
