// SPDX-License-Identifier: Apache-2.0
#include "config/run_options.h"

#include <fmt/format.h>

#include <charconv>

#include "config/check/report_times.h"
#include "config/network_option.h"
#include "config/xml/plant_rules.h"
#include "core/base/duration.h"

namespace indurop::config {
namespace {

constexpr double kMaxSpeed = 1e6;

base::DurationText read_time(const std::string& text) {
  return base::read_duration(text, false, base::PlainNumber::Seconds);
}

std::string check_node(const std::string& text) {
  return is_node_name(text)
             ? ""
             : fmt::format("'{}' is not a valid node name: use 1 to 40 letters, digits, '_' or '-'", text);
}

std::string take_spin(const std::string& text, std::optional<SpinSetting>& to) {
  if (text == "auto") {
    to = SpinSetting{};
  } else if (text == "off") {
    to = SpinSetting{SpinSetting::Mode::Off, {}};
  } else {
    const base::DurationText time = read_time(text);
    to = time.value ? SpinSetting{SpinSetting::Mode::Fixed, *time.value} : to;
    return time.problem;
  }
  return {};
}

std::string take_speed(const std::string& text, double& to) {
  if (text == "max") {
    to = 0;
    return {};
  }
  const auto end = std::from_chars(text.data(), text.data() + text.size(), to);
  const bool ok = end.ec == std::errc() && end.ptr == text.data() + text.size() && to > 0 && to <= kMaxSpeed;
  return ok ? "" : fmt::format("'{}' is not a speed: use max or a factor of real time, such as 1, 0.5 or 10", text);
}

void declare_simulation(base::Options& line, Simulation& simulation) {
  const base::Option sim = line.flag("--sim", simulation.on, "Run in virtual time, the same way on every run");
  const auto speed = [&simulation](const std::string& text) { return take_speed(text, simulation.speed); };
  line.add("--speed", "max|N", speed, "With --sim: factor of real time (default: max)").needs(sim);
  line.flag("--step", simulation.step, "With --sim: pause after each tick; Enter continues, 10 or 20ms runs further")
      .needs(sim);
  const auto times = [&simulation](const std::string& file) {
    simulation.times = file;
    return read_measured_times(file, simulation.measured);
  };
  line.add("--times", "FILE", times,
           "With --sim: modules without <wcet> take their maximum execution time in this report of --report")
      .needs(sim)
      .completes(base::Completion::File);
  const auto network = [&simulation](const std::string& text) {
    SimulatedNetwork ignored;
    simulation.network = text;
    return read_network(text, ignored);
  };
  line.add("--network", "SETTINGS", network,
           "With --sim of a plant: delay=200us,jitter=50us,loss=0.001,seed=7 between its boards")
      .needs(sim);
  line.add("--script", "FILE", simulation.script,
           "With --sim of a plant: when boards are killed, cut off and reconnected: lines like 500ms kill sensor")
      .needs(sim)
      .completes(base::Completion::File);
  line.add("--conductor", "FD", simulation.conductor, "Part of a simulated plant (set by the simulation)").needs(sim);
}

std::string spin_word(const SpinSetting& spin) {
  switch (spin.mode) {
    case SpinSetting::Mode::Auto:
      return "auto";
    case SpinSetting::Mode::Off:
      return "off";
    case SpinSetting::Mode::Fixed:
      break;
  }
  return std::to_string(spin.fixed.count()) + "ns";
}

}  // namespace

void declare_run_options(base::Options& line, RunOptions& options) {
  const auto take_duration = [&options](const std::string& text) {
    const base::DurationText time = read_time(text);
    options.duration = time.value;
    return time.problem;
  };
  const auto spin = [&options](const std::string& text) { return take_spin(text, options.spin); };
  line.add("config", "FILE", options.config, "module.xml, or a plant's manifest with --board");
  const base::Option board =
      line.add("--board", "NAME", options.board, "Board of the plant to run as").check(check_node);
  line.flag("--one-host", options.one_host, "All boards of the plant run on this host: use only loopback").needs(board);
  line.add("--deployment", "ID", options.deployment, "Id that indurop status shows (set by the agent)").needs(board);
  line.add("--node", "NAME", options.node, "Name of the node on this host (default: that of the board, else local)")
      .check(check_node);
  line.add("--duration,--until", "TIME", take_duration, "End after this time (5s, 500ms)");
  line.add("--report", "FILE", options.report, "Write statistics to this JSON file at the end");
  line.flag("--require-rt", options.require_rt, "Exit with code 7 unless real-time privileges were obtained");
  line.flag("--adjust", options.adjust, "Use the nearest valid periods instead of rejecting too short ones");
  line.add("--core", "N", options.core, "Core for all modules without <core>");
  line.add("--spin", "auto|off|TIME", spin, "Time to spin before each tick");
  line.add("--tape", "MB", options.tape_megabytes,
           "Memory for the tape of the last runs, in MB (default: 20); 0: no tape, nothing can be recorded");
  line.add("--replay", "FILE", options.replay.file,
           "Replay this recording of --record and compare the values that modules write")
      .completes(base::Completion::File);
  line.add("--replay-board", "NAME", options.replay.board,
           "With --replay: board to replay, if the recording has several");
  line.add("--with", "FILE.so", options.replay.with,
           "With --replay: use this file for the module of its name, or of MODULE=FILE; may be given several times")
      .completes(base::Completion::File);
  line.add("--replay-output", "FILE", options.replay.output,
           "With --replay: write the values that modules write now to this MCAP file")
      .completes(base::Completion::File);
  line.add("--replay-report", "FILE", options.replay.report,
           "With --replay and one --with: repeat only its module, which continues with its own results, and write the "
           "differences to this JSON file")
      .completes(base::Completion::File);
  line.add("--replay-kept", "FILE", options.replay.kept,
           "With --replay: write what modules keep at the end of the replay to this JSON file")
      .completes(base::Completion::File);
  line.add("--replay-from", "TICK", options.replay.from_tick, "With --replay: first tick whose runs are compared");
  line.add("--replay-to", "TICK", options.replay.to_tick, "With --replay: last tick whose runs are compared");
  line.add("--replay-stop-at", "TICK", options.replay.stop_tick,
           "With --replay: stop this process before the runs of this tick, for a debugger; SIGCONT continues it");
  line.add("--record", "FILE", options.record, "Record every run of every module to this MCAP file")
      .completes(base::Completion::File);
  declare_simulation(line, options.simulation);
}

std::vector<std::string> words_of(const RunOptions& options) {
  std::vector<std::string> words;
  const auto value = [&words](const char* name, const std::string& text) {
    if (!text.empty()) {
      words.insert(words.end(), {name, text});
    }
  };
  const auto flag = [&words](const char* name, bool given) {
    if (given) {
      words.emplace_back(name);
    }
  };
  value("--board", options.board);
  flag("--one-host", options.one_host);
  value("--deployment", options.deployment);
  value("--node", options.node);
  value("--duration", options.duration ? std::to_string(options.duration->count()) + "ns" : "");
  value("--report", options.report.string());
  flag("--require-rt", options.require_rt);
  flag("--adjust", options.adjust);
  value("--core", options.core ? std::to_string(*options.core) : "");
  value("--spin", options.spin ? spin_word(*options.spin) : "");
  value("--tape", options.tape_megabytes != kTapeMegabytes ? std::to_string(options.tape_megabytes) : "");
  value("--record", options.record.string());
  value("--replay", options.replay.file.string());
  value("--replay-board", options.replay.board);
  for (const std::string& file : options.replay.with) {
    value("--with", file);
  }
  value("--replay-output", options.replay.output.string());
  value("--replay-report", options.replay.report.string());
  value("--replay-kept", options.replay.kept.string());
  value("--replay-from", options.replay.from_tick > 0 ? std::to_string(options.replay.from_tick) : "");
  value("--replay-to", options.replay.to_tick != Replay::kLastTick ? std::to_string(options.replay.to_tick) : "");
  value("--replay-stop-at",
        options.replay.stop_tick != Replay::kLastTick ? std::to_string(options.replay.stop_tick) : "");
  flag("--sim", options.simulation.on);
  flag("--step", options.simulation.step);
  value("--speed", options.simulation.speed > 0 ? fmt::format("{}", options.simulation.speed) : "");
  value("--times", options.simulation.times);
  value("--network", options.simulation.network);
  value("--script", options.simulation.script.string());
  value("--conductor", options.simulation.conductor ? std::to_string(*options.simulation.conductor) : "");
  flag("--quiet", options.quiet);
  if (!options.config.empty()) {
    words.insert(words.end(), {"--", options.config.string()});
  }
  return words;
}

}  // namespace indurop::config
