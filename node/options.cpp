// SPDX-License-Identifier: Apache-2.0
#include "node/options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdlib>

#include "deploy/reader.h"
#include "vars/shm_file.h"

namespace indurop::node {
namespace {

std::string check_duration(const std::string& text) {
  return deploy::parse_duration(text) ? ""
                                      : fmt::format("'{}' is no duration: write 500ms, 5s, 100us or nanoseconds", text);
}

std::string check_node(const std::string& text) {
  return vars::valid_node_name(text)
             ? ""
             : fmt::format("'{}' is no node name: use 1 to 40 letters, digits, '_' or '-'", text);
}

std::string check_spin(const std::string& text) {
  return text == "auto" || text == "off" ? "" : check_duration(text);
}

deploy::SpinSetting to_spin(const std::string& text) {
  if (text == "auto") {
    return {};
  }
  if (text == "off") {
    return {deploy::SpinSetting::Mode::Off, {}};
  }
  return {deploy::SpinSetting::Mode::Fixed, *deploy::parse_duration(text)};
}

}  // namespace

// NOLINTNEXTLINE(readability-function-size): a list
std::optional<Options> parse_options(int argc, char** argv, int& exit_code) {
  Options options;
  std::string duration;
  std::string spin;
  std::string node;
  if (const char* named = std::getenv("INDUROP_NODE"); named != nullptr) {
    node = named;
  }
  CLI::App app{"Runs the modules of a module.xml, or of one board of a plant, on this host, each on its own schedule.",
               "indurop-node"};
  app.set_version_flag("--version", INDUROP_VERSION);
  auto* config = app.add_option("config", options.config, "module.xml, or a plant's manifest with --board");
  auto* board = app.add_option("--board", options.board, "board of the plant to be")->check(check_node);
  app.add_flag("--one-host", options.one_host, "all boards of the plant run on this host: stay on loopback")
      ->needs(board);
  app.add_option("--deployment", options.deployment, "id that indurop status shows (given by the agent)")->needs(board);
  auto* agent = app.add_flag("--agent", options.agent, "stay and run what indurop deploy sends to this board")
                    ->needs(board)
                    ->excludes(config);
  app.add_option("--domain", options.domain, "DDS domain of the agents (default: 76)")
      ->needs(agent)
      ->check(CLI::Range(0, 230));
  app.add_option("--interface", options.interface_name, "network interface of the agent (default: the only one)")
      ->needs(agent);
  app.add_option("--node", node, "name of the node on this host (default: that of the board, else local)")
      ->check(check_node);
  app.add_option("--duration", duration, "end after this time (5s, 500ms)")->check(check_duration);
  app.add_option("--report", options.report, "write statistics to this JSON file at the end");
  app.add_flag("--require-rt", options.require_rt, "exit with code 7 unless real-time rights were obtained");
  app.add_flag("--adjust", options.adjust, "use the nearest periods that work instead of refusing too small ones");
  app.add_option("--core", options.core, "core of all modules that name none");
  app.add_option("--spin", spin, "auto, off or a time to spin before each tick")->check(check_spin);
  app.add_flag("-q,--quiet", options.quiet, "only warnings and errors");
  app.footer(
      "indurop-node --agent --board NAME makes this host a board that indurop deploy can reach.\n"
      "indurop run PLANT --local runs all boards of a plant on this host.\n\n"
      "Exit codes: 0 ok, 1 failed, 2 usage, 4 configuration has errors, 7 real-time rights not obtained\n"
      "(--require-rt), 8 variables of modules disagree, 130 interrupted.");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    exit_code = app.exit(error) == 0 ? kOk : kUsage;
    return std::nullopt;
  }
  if (options.config.empty() && !options.agent) {
    fmt::print(stderr, "indurop-node: error: name a module.xml, a plant's manifest, or --agent\n");
    exit_code = kUsage;
    return std::nullopt;
  }
  if (node.empty()) {
    node = options.board.empty() ? options.node : options.board;
  }
  options.node = node;
  if (!vars::valid_node_name(options.node)) {
    fmt::print(stderr, "indurop-node: error: INDUROP_NODE: {}\n", check_node(options.node));
    exit_code = kUsage;
    return std::nullopt;
  }
  if (!duration.empty()) {
    options.duration = deploy::parse_duration(duration);
  }
  if (!spin.empty()) {
    options.spin = to_spin(spin);
  }
  return options;
}

}  // namespace indurop::node
