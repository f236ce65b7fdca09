// SPDX-License-Identifier: Apache-2.0
#include "tools/client/recordings/replay_setup.h"

#include <fmt/format.h>

#include <system_error>
#include <utility>

#include "history/recorder/sources.h"
#include "history/recording/mcap_reader.h"

namespace indurop::tools {

Result<config::RunOptions, base::Problem> replay_setup(const std::filesystem::path& file, const std::string& board,
                                                       const std::filesystem::path& config) {
  auto reader = recording::McapReader::open(file);
  if (!reader) {
    return std::move(reader).error();
  }
  const recorder::Sources sources = recorder::find_sources(*reader);
  const auto source = recorder::choose_source(sources, board, file.string());
  if (!source) {
    return source.error();
  }
  const recorder::Source& about = sources.all[*source];
  config::RunOptions run;
  run.replay.file = file;
  run.replay.board = board;
  run.config = config.empty() ? std::filesystem::path(about.text("config")) : config;
  run.board = about.text("board");
  if (run.config.empty()) {
    return base::Problem{
        fmt::format("{} does not name the configuration with which it was recorded, because its recorder ended before "
                    "it had written the first runs; name it with --config",
                    file.string())};
  }
  std::error_code ignored;
  if (!std::filesystem::exists(run.config, ignored)) {
    return base::Problem{
        fmt::format("{} was recorded with {}, which is missing here; name the configuration with --config",
                    file.string(), run.config.string())};
  }
  return run;
}

}  // namespace indurop::tools
