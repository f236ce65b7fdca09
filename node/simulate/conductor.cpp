// SPDX-License-Identifier: Apache-2.0
#include "node/simulate/conductor.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstring>
#include <optional>
#include <utility>
#include <vector>

#include "config/check/check_plant.h"
#include "config/network_option.h"
#include "config/xml/plant_reader.h"
#include "core/base/duration.h"
#include "core/base/print.h"
#include "core/rt/clock.h"
#include "network/mirror/simulated/network.h"
#include "node/run/console.h"
#include "node/run/ending.h"
#include "node/run/one_core.h"
#include "node/simulate/conductor_board.h"
#include "node/simulate/plant_script.h"
#include "node/simulate/simulation.h"
#include "node/simulate/step_input.h"

namespace indurop::node {
namespace {

constexpr std::int64_t kNever = INT64_MAX;

mirror::NetworkModel model_of(const config::Plant& plant) {
  mirror::NetworkModel model;
  model.delay = plant.network.delay;
  model.jitter = plant.network.jitter;
  model.loss = plant.network.loss;
  model.repeat = plant.network.repeat;
  model.seed = static_cast<std::uint64_t>(plant.network.seed);
  model.lease = plant.lease;
  return model;
}

class Conductor {
 public:
  Conductor(const Options& options, Console& console, base::StopSignal& signals, const config::Plant& plant,
            std::vector<PlantEvent> events)
      : options_(options),
        console_(console),
        signals_(signals),
        delay_ns_(plant.network.delay.count()),
        network_(model_of(plant), plant.boards.size()),
        events_(std::move(events)) {
    for (const config::Board& board : plant.boards) {
      boards_.emplace_back(board.name);
      place_.boards.push_back(board.name);
    }
    place_.begin_ns = rt::to_ns(Simulation::kBegin);
  }

  int run() {
    Ending ending = start();
    if (ending.code == kOk) {
      ending = conduct();
    }
    return conclude(ending);
  }

 private:
  Ending start();
  bool start_board(std::size_t number, const Options& options);
  Ending conduct();
  [[nodiscard]] std::int64_t reachable() const;
  void advance(std::int64_t until_ns, bool all);
  void take_answer(std::size_t number, std::int64_t until_ns);
  void apply(const PlantEvent& event);
  void bring_back(std::size_t number);
  int keep_pace();
  std::optional<Ending> stand();
  [[nodiscard]] bool over() const;
  int conclude(const Ending& ending);

  const Options& options_;
  Console& console_;
  base::StopSignal& signals_;
  std::int64_t delay_ns_;
  mirror::SimulatedNetwork network_;
  std::vector<PlantEvent> events_;
  std::size_t next_event_ = 0;
  std::vector<ConductorBoard> boards_;
  BoardPlace place_;
  std::int64_t now_ns_ = 0;
  std::int64_t epoch_ns_ = kNever;         // of the first tick of all boards
  std::int64_t basic_period_ns_ = kNever;  // the shortest of all boards
  std::int64_t stands_at_ns_ = kNever;     // --step
  std::vector<bool> returned_;
  OneCore core_;
  StepInput input_;
  rt::MonoTime began_;  // in real time
};

bool Conductor::start_board(std::size_t number, const Options& options) {
  place_.own = static_cast<std::uint32_t>(number);
  const Status started = boards_[number].start(options, place_);
  if (!started) {
    console_.error("board {} cannot be started: {}", boards_[number].name(), describe(started.error()));
  }
  return started.ok();
}

Ending Conductor::start() {
  returned_.assign(boards_.size(), false);
  for (std::size_t i = 0; i < boards_.size(); ++i) {
    if (!start_board(i, options_)) {
      return Ending{kFailed};
    }
  }
  now_ns_ = place_.begin_ns;
  for (std::size_t i = 0; i < boards_.size(); ++i) {
    if (!boards_[i].await_answer(signals_)) {
      return Ending{kFailed};  // it has printed the reason
    }
    epoch_ns_ = std::min(epoch_ns_, boards_[i].answer().epoch_ns);
    basic_period_ns_ = std::min(basic_period_ns_, boards_[i].answer().basic_period_ns);
    take_answer(i, now_ns_);
    core_.add(boards_[i].pid());
  }
  began_ = rt::MonoClock::now();
  stands_at_ns_ = options_.simulation.step ? epoch_ns_ - 1 : kNever;
  return {};
}

// The time up to which no board can receive a message that is not known yet.
std::int64_t Conductor::reachable() const {
  std::int64_t first = kNever;
  for (std::size_t i = 0; i < boards_.size(); ++i) {
    if (boards_[i].runs()) {
      first = std::min({first, boards_[i].next_ns(), network_.next_question(i)});
    }
  }
  return first > kNever - delay_ns_ ? kNever : first + delay_ns_ - 1;
}

void Conductor::take_answer(std::size_t number, std::int64_t until_ns) {
  for (mirror::Message& message : boards_[number].take_sent()) {
    network_.send(std::move(message), until_ns + 1);
  }
  if (boards_[number].answer().ended) {
    network_.leave(number, until_ns);
    boards_[number].close_channel();
  }
}

// `all`: also boards that have no event until then.
void Conductor::advance(std::int64_t until_ns, bool all) {
  std::vector<bool> asked(boards_.size());
  for (std::size_t i = 0; i < boards_.size(); ++i) {
    if (!boards_[i].runs()) {
      continue;
    }
    BoardOrder order;
    order.until_ns = until_ns;
    order.arrivals = network_.take(i, until_ns);
    asked[i] = all || !order.arrivals.empty() || boards_[i].next_ns() <= until_ns;
    if (asked[i]) {
      boards_[i].order(order);
    }
  }
  now_ns_ = until_ns;
  std::chrono::nanoseconds took{};
  for (std::size_t i = 0; i < boards_.size(); ++i) {
    if (!asked[i]) {
      continue;
    }
    if (boards_[i].await_answer(signals_)) {
      took += std::chrono::nanoseconds(boards_[i].answer().took_ns);
      take_answer(i, until_ns);
    } else {
      console_.warning("board {} has ended; the others continue", boards_[i].name());
      network_.leave(i, until_ns);
    }
  }
  core_.round(took);
}

void Conductor::apply(const PlantEvent& event) {
  ConductorBoard& board = boards_[event.board];
  console_.info("{} after {}", event.text, base::format_duration(event.at));
  switch (event.what) {
    case PlantEvent::What::Kill:
      board.kill();
      network_.kill(event.board, now_ns_);
      break;
    case PlantEvent::What::Cut:
      network_.cut(event.board, now_ns_);
      break;
    case PlantEvent::What::Return:
      network_.join(event.board, now_ns_);
      if (!board.runs()) {
        bring_back(event.board);
      }
      break;
  }
}

void Conductor::bring_back(std::size_t number) {
  (void)boards_[number].await_end();
  Options options = options_;
  options.duration.reset();  // ends with the others
  place_.begin_ns = now_ns_;
  returned_[number] = true;
  if (!start_board(number, options)) {
    return;
  }
  if (boards_[number].await_answer(signals_)) {
    core_.add(boards_[number].pid());
    network_.start(number, now_ns_);
    take_answer(number, now_ns_);
  }
}

// Returns true if the boards that were started at the beginning have ended.
bool Conductor::over() const {
  bool any = false;
  for (std::size_t i = 0; i < boards_.size(); ++i) {
    if (boards_[i].runs()) {
      any = true;
      if (!returned_[i]) {
        return false;
      }
    }
  }
  if (!any) {
    return next_event_ == events_.size();
  }
  // The others have no duration of their own.
  return options_.duration && now_ns_ >= epoch_ns_ + options_.duration->count();
}

int Conductor::keep_pace() {
  std::chrono::nanoseconds left{0};
  if (options_.simulation.speed > 0) {
    const auto passed = static_cast<double>(now_ns_ - rt::to_ns(Simulation::kBegin));
    const rt::MonoTime due =
        began_ + std::chrono::nanoseconds(static_cast<std::int64_t>(passed / options_.simulation.speed));
    left = std::max(due - rt::MonoClock::now(), left);
  }
  return signals_.wait(left);
}

// Pauses after a tick of all boards, until standard input requests to continue.
std::optional<Ending> Conductor::stand() {
  print_position(static_cast<std::uint64_t>((stands_at_ns_ + 1 - epoch_ns_) / basic_period_ns_), basic_period_ns_);
  const StepInput::Order order = input_.next(signals_, basic_period_ns_);
  if (order.end) {
    return Ending{kOk, "end of the steps"};
  }
  stands_at_ns_ += order.ticks * basic_period_ns_;
  return std::nullopt;
}

Ending Conductor::conduct() {
  while (!over()) {
    if (const int number = keep_pace(); number != 0) {
      return {number == SIGINT ? kInterrupted : kOk, fmt::format("signal {} ({})", number, ::strsignal(number))};
    }
    const std::int64_t script = next_event_ < events_.size() ? epoch_ns_ + events_[next_event_].at.count() : kNever;
    const std::int64_t limit = std::min(script, stands_at_ns_);
    const std::int64_t until = std::max(std::min(reachable(), limit), now_ns_);
    if (until == kNever) {
      return {kFailed, "no further events"};
    }
    advance(until, until == limit);
    for (; next_event_ < events_.size() && epoch_ns_ + events_[next_event_].at.count() <= now_ns_; ++next_event_) {
      apply(events_[next_event_]);
    }
    if (now_ns_ == stands_at_ns_) {
      if (auto ending = stand()) {
        return *std::move(ending);
      }
    }
  }
  return {};
}

int Conductor::conclude(const Ending& ending) {
  const int signal = signals_.received();
  for (ConductorBoard& board : boards_) {
    if (board.runs()) {
      board.order({true, signal, 0, {}});
    }
  }
  int code = ending.code;
  for (ConductorBoard& board : boards_) {
    const int its = board.await_end();
    if (its != kOk && its != kInterrupted && code == kOk) {
      console_.error("board {} ended with exit code {}", board.name(), its);
    }
    code = code == kOk || (code == kFailed && ending.code == kFailed && its != kOk) ? its : code;
  }
  return code;
}

}  // namespace

int run_plant(const Options& options) {
  Console console(options.node.empty() ? "plant" : options.node, options.quiet);
  base::StopSignal signals;
  config::ReadPlant read = config::read_plant(options.config);
  std::vector<base::Diagnostic> diagnostics = read.diagnostics;
  bool ok = read.ok();
  std::vector<std::string> names;
  for (const config::Board& board : read.plant.boards) {
    names.push_back(board.name);
  }
  if (ok) {
    const config::PlantCheck check = config::check_plant(read.plant, {.adjust = options.adjust, .machine = false});
    diagnostics.insert(diagnostics.end(), check.diagnostics.begin(), check.diagnostics.end());
    ok = check.ok();
    (void)config::read_network(options.simulation.network, read.plant.network);  // was checked with the command line
  }
  PlantScript script;
  if (ok && !options.simulation.script.empty()) {
    script = read_script(options.simulation.script, names, options.duration);
    diagnostics.insert(diagnostics.end(), script.diagnostics.begin(), script.diagnostics.end());
    ok = !base::has_error(script.diagnostics);
  }
  for (const base::Diagnostic& diagnostic : diagnostics) {
    if (diagnostic.severity != base::Diagnostic::Severity::Note) {
      base::print(stderr, "{}\n", base::to_string(diagnostic));
    }
  }
  if (!ok) {
    return kCheckFailed;
  }
  return Conductor(options, console, signals, read.plant, std::move(script.events)).run();
}

}  // namespace indurop::node
