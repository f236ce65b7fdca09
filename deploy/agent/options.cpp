// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/options.h"

#include <fmt/format.h>

#include "core/base/exit_code.h"
#include "core/base/journal.h"
#include "core/base/options.h"
#include "store/vars/shm_file.h"

namespace indurop::deploy {
namespace {

std::string check_board(const std::string& text) {
  return vars::valid_node_name(text)
             ? ""
             : fmt::format("'{}' is not a valid board name: use 1 to 40 letters, digits, '_' or '-'", text);
}

}  // namespace

std::vector<std::string> node_arguments(const AgentOptions& options) {
  std::vector<std::string> words;
  if (options.link.network.one_host) {
    words.emplace_back("--one-host");
  }
  if (options.core) {
    words.insert(words.end(), {"--core", std::to_string(*options.core)});
  }
  if (options.require_rt) {
    words.emplace_back("--require-rt");
  }
  if (options.quiet) {
    words.emplace_back("--quiet");
  }
  if (options.journal) {
    words.emplace_back("--journal");
  }
  return words;
}

std::vector<std::string> pools_arguments(const AgentOptions& options) {
  return options.quiet ? std::vector<std::string>{"--quiet"} : std::vector<std::string>{};
}

LinkSettings link_settings(const AgentOptions& options, std::uint64_t self) {
  LinkSettings settings = options.link;
  settings.self = self;
  settings.network.board = options.board;
  return settings;
}

Result<AgentOptions, int> parse_options(int argc, char** argv) {
  AgentOptions options;
  base::Options line("indurop-agent",
                     "Make this host a board of a plant: run the last deployment of indurop deploy, accept new ones");
  line.version(INDUROP_VERSION);
  line.add("--board", "NAME", options.board, "Name of the board").required().check(check_board);
  add_agent_options(line, options.link);
  line.add("--core", "N", options.core, "Core for all modules without <core>");
  line.flag("--require-rt", options.require_rt, "End the node unless real-time privileges were obtained");
  line.flag("-q,--quiet", options.quiet, "Only warnings and errors");
  line.exit_codes({kOk, kFailed, kUsage, kInterrupted});
  if (const auto code = line.parse_program(argc, argv)) {
    return *code;
  }
  options.journal = base::stderr_is_journal();
  return options;
}

}  // namespace indurop::deploy
