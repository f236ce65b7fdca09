// SPDX-License-Identifier: Apache-2.0
// indurop recording: the subcommands that work on existing recordings.
#include "tools/cli/recordings/recording_cut.h"
#include "tools/cli/recordings/recording_export.h"
#include "tools/cli/recordings/recording_info.h"
#include "tools/cli/recordings/recording_join.h"
#include "tools/cli/recordings/recording_play.h"
#include "tools/cli/verbs/verbs.h"

namespace indurop::tools {
namespace {

Action declare_recording(base::Options& app, Context& context) {
  auto chosen = std::make_shared<Action>();
  add_recording_info(app, context, chosen);
  add_recording_export(app, chosen);
  add_recording_cut(app, chosen);
  add_recording_join(app, chosen);
  add_recording_play(app, context, chosen);
  return [chosen](Context& c) { return (*chosen)(c); };
}

}  // namespace

const Verb kRecordingVerb{
    "recording", "Variables", "Show, export, cut and join recordings, and play them into a running node",
    "Recordings are made by record and run --record; black boxes are recordings, too. replay runs their modules\n"
    "again.\n"
    "Examples:\n"
    "  indurop recording info run.mcap\n"
    "  indurop recording export run.mcap 'PLC_ROBOT::*' --csv run.csv\n"
    "  indurop recording export run.mcap --trace trace.json   # for ui.perfetto.dev\n"
    "  indurop recording cut run.mcap --from 58s --to 60s -o crash.mcap\n"
    "  indurop recording join run.sensor.mcap run.control.mcap -o plant.mcap\n"
    "  indurop recording play run.mcap\n",
    &declare_recording};

}  // namespace indurop::tools
