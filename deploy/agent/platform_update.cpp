// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/platform_update.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <utility>

#include "deploy/agent/release_programs.h"

namespace indurop::deploy {
namespace {

using Do = BoardTransaction::Do;

constexpr std::chrono::minutes kRecent{15};  // longer than any trial

// Returns true if the deployer of the switch may still wait for this board.
bool is_recent(const LastSwitch& last) {
  const std::chrono::nanoseconds past{rt::wall_ns() - last.begun_ns};
  return past > -kRecent && past < kRecent;
}

std::string current_of(const Committed& committed) {
  return committed.current.empty() ? kInstalledRelease : committed.current;
}

}  // namespace

std::uint64_t continued_session(const AgentState& platform) {
  const auto last = load_switch(platform.folder());
  const bool open = last && last->order.generation > platform.committed().generation;
  return open && is_recent(*last) ? last->session : 0;
}

PlatformUpdate::PlatformUpdate(std::string board, std::uint64_t self, const RunningRelease& running, AgentState& state,
                               const DeployKeys& keys, BoardProcess& process, const base::Log& log)
    : board_(std::move(board)),
      self_(self),
      host_(host_name()),
      running_(running),
      state_(state),
      keys_(keys),
      process_(process),
      log_(log),
      transaction_(board_),
      fetcher_(state, self, board_),
      server_(self,
              [this](const std::string& name) {
                const auto text = [](std::string what) { return BlobServer::Blob{{}, std::move(what)}; };
                return name == kHistoryBlob ? std::optional(text(state_.history_text()))
                       : state_.has(name)   ? std::optional(BlobServer::Blob{state_.file(name), {}})
                                            : std::nullopt;
              }),
      keys_plant_(keys.own({}).plant),
      last_(load_switch(state.folder())),
      begun_(rt::MonoClock::now()) {
  if (running_.upgraded) {
    Committed next = state_.committed();
    next.previous = next.current;
    next.current = kInstalledRelease;
    next.comment = INDUROP_VERSION;
    (void)state_.commit(std::move(next));
  }
  if (last_ && last_->order.generation > state_.committed().generation && is_recent(*last_)) {
    transaction_.resume(last_->order, last_->joining, last_->ended, begun_);
    log_.info("release {}: {}", title_of(last_->order.deployment),
              last_->ended.empty() ? "its agent has started, the trial goes on" : "rolled back: " + last_->ended);
  }
}

std::string PlatformUpdate::version_of(const std::string& id) const {
  if (id == kInstalledRelease) {
    return running_.id == kInstalledRelease || !last_ ? INDUROP_VERSION : last_->installed;
  }
  const auto package = state_.package(id);
  return package ? package->release : "?";
}

std::string PlatformUpdate::title_of(const std::string& id) const {
  return id == kInstalledRelease ? fmt::format("{} (installed)", version_of(id))
                                 : fmt::format("{} ({})", version_of(id), shown_id(id));
}

void PlatformUpdate::step(DeployLink* link, const CommittedDeployment& plant, bool idle, rt::MonoTime now) {
  plant_ = plant;
  if (plant_.plant.empty()) {
    plant_.plant = keys_plant_;
    plant_.members = {board_};
  }
  if (leaving_) {
    if (link != nullptr && schedule_.take_due(transaction_.phase(), process_.condition(), 0, now)) {
      link->publish(report());
    }
    return;
  }
  if (link != nullptr) {
    listen(*link, idle, now);
    work(*link, now);
  }
  perform(transaction_.time(now), now);
  follow(now);
  note_alive(now);
  if (link != nullptr && schedule_.take_due(transaction_.phase(), process_.condition(), 0, now)) {
    link->publish(report());
  }
}

void PlatformUpdate::listen(DeployLink& link, bool idle, rt::MonoTime now) {
  for (const auto& news : link.take_orders()) {
    if (!news.gone && may_order(news.order, idle)) {
      perform(transaction_.receive(news.order, now, rt::WallClock::now()), now);
    }
  }
  for (auto& news : link.take_boards()) {
    if (news.gone) {
      peers_.erase(news.report.board);
    } else {
      peers_[news.report.board] = std::move(news.report);
    }
  }
  for (const auto& [name, other] : peers_) {
    perform(transaction_.committed_elsewhere(other), now);
    if (idle && lacks(other) &&
        keys_.refusal(other.plant, grant_text(other.plant, other.current, other.generation), other.grant).empty()) {
      perform(transaction_.catch_up(other, now), now);
    }
  }
}

// Returns the number of the plant's last update. That of a plant to which the board belonged before does not count
// here: the board would bring its release along.
std::uint64_t PlatformUpdate::generation() const {
  return state_.committed().plant == plant_.plant ? state_.committed().generation : 0;
}

// Returns true if another board of the plant has a newer release, which this board missed. One that failed here is not
// tried without an order: each trial stops the plant. A trial that ended because the power was lost for longer
// than it may last is no failure if others committed it; that is tried again.
bool PlatformUpdate::lacks(const BoardReport& other) const {
  const bool member = std::find(other.members.begin(), other.members.end(), board_) != other.members.end();
  const bool interrupted = last_ && last_->expired && !last_->joining;
  const bool failed = last_ && last_->order.generation == other.generation && !last_->ended.empty() && !interrupted;
  return other.board != board_ && member && !failed && other.plant == plant_.plant && other.generation > generation();
}

std::string PlatformUpdate::refusal_of(const Order& order, bool idle) const {
  std::string why = keys_.refusal(order.plant, order_text(order), order.signature);
  if (why.empty()) {
    why = keys_.refusal(order.plant, grant_text(order.plant, order.deployment, order.generation), order.grant);
  }
  if (!why.empty()) {
    return why;
  }
  if (order.plant != plant_.plant) {
    return fmt::format("this board is of plant {}", plant_.plant.empty() ? "none" : plant_.plant);
  }
  const bool begins = order.step == Step::Prepare && order.deployer != transaction_.order().deployer;
  if (begins && !idle) {
    return "a deployment is under way";
  }
  return begins && transaction_.phase() == Phase::Steady && order.generation <= generation()
             ? "the platform of this board was updated since; try again"
             : "";
}

bool PlatformUpdate::may_order(const Order& order, bool idle) {
  if (std::find(order.boards.begin(), order.boards.end(), board_) == order.boards.end()) {
    return false;
  }
  const std::string why = refusal_of(order, idle);
  if (!why.empty() && order.step == Step::Prepare && refused_ != order.deployer) {
    log_.warning("an order from {} about the platform was rejected: {}", order.host, why);
    refused_ = order.deployer;
    refusal_ = why;
    schedule_.request();
  }
  return why.empty();
}

void PlatformUpdate::work(DeployLink& link, rt::MonoTime now) {
  if (fetcher_.active()) {
    const Fetcher::State state = fetcher_.step(link, now);
    if (state != Fetcher::State::Working) {
      perform(transaction_.fetched(state == Fetcher::State::Done ? std::string() : fetcher_.problem()), now);
    }
  } else {
    (void)link.take_chunks();
  }
  (void)server_.serve(link, now);
}

void PlatformUpdate::follow(rt::MonoTime now) {
  const Phase phase = transaction_.phase();
  if (!leaving_ && (phase == Phase::Trial || phase == Phase::Healthy)) {
    const std::chrono::nanoseconds past{rt::wall_ns() - last_->begun_ns};  // useless if the clock was set meanwhile
    if (stood_.count() == 0 && process_.condition() == NodeCondition::Running && past.count() > 0 && past < kRecent) {
      stood_ = past;
      log_.info("release {}: the node stood for {:.1f} s", version(), std::chrono::duration<double>(stood_).count());
    }
    const BoardProcess::Health health = process_.health(transaction_.order().boards);
    perform(transaction_.node(health.problem, health.missing, now), now);
  }
}

// A start that went well is forgotten, so that only starts in a row count against a release.
void PlatformUpdate::note_alive(rt::MonoTime now) {
  if (released_ || now - begun_ < kAliveAfter || !last_ || last_->order.generation > state_.committed().generation) {
    return;
  }
  released_ = true;
  if (std::exchange(last_->starts, 0) > 0) {
    (void)note_switch();
  }
}

std::string PlatformUpdate::note_switch() {
  const auto written = save_switch(state_.folder(), *last_);
  if (!written) {
    log_.error("{}", written.error().text);
  }
  return written ? std::string() : written.error().text;
}

void PlatformUpdate::perform(Do what, rt::MonoTime now) {
  const Order& order = transaction_.order();
  switch (what) {
    case Do::Nothing:
      return;
    case Do::Fetch:
      log_.info("release {} of {}: fetching", shown_id(order.deployment), order.host);
      if (order.deployment == kInstalledRelease) {
        perform(transaction_.fetched({}), now);
      } else {
        fetcher_.begin(sources_of(order.deployment), order.deployment, order.size);
      }
      break;
    case Do::Check:
      perform(transaction_.checked(check(), rt::MonoClock::now()), rt::MonoClock::now());
      break;
    case Do::Load:
      perform(transaction_.loaded({}, false, now), now);  // programs are not exchanged while they run
      break;
    case Do::Enter:
      break;
    case Do::Switch:
      prepare_switch();
      break;
    case Do::Commit:
      commit(order);
      break;
    case Do::GoBack:
      go_back(order);
      break;
    case Do::Forget:
      fetcher_.cancel();
      log_.warning("release {}: abandoned: {}", shown_id(order.deployment), transaction_.message());
      state_.collect_garbage(order.deployment);
      break;
  }
  schedule_.request();
}

// Returns the sessions that have its files: that which offers it, and the boards that run it.
std::vector<std::uint64_t> PlatformUpdate::sources_of(const std::string& id) const {
  std::vector<std::uint64_t> all{transaction_.source()};
  for (const auto& [name, other] : peers_) {
    if (other.current == id && other.agent != all.front() && name != board_) {
      all.push_back(other.agent);
    }
  }
  return all;
}

std::string PlatformUpdate::check() const {
  const std::string& id = transaction_.order().deployment;
  if (id == kInstalledRelease) {
    return {};
  }
  if (const auto installed = state_.install(id); !installed) {
    return installed.error().text;
  }
  const auto release = sound_release(state_.files(), id);
  const auto tried = release ? try_release(state_.files(), *release) : release.error();
  return tried ? std::string() : tried.error().text;
}

// From now on every start of this board's agent is one of the new release, until the trial is over.
void PlatformUpdate::prepare_switch() {
  const Order& order = transaction_.order();
  log_.info("release {}: switching", title_of(order.deployment));
  last_ = LastSwitch{order, transaction_.joining(), self_, rt::wall_ns(), 0, {}, version_of(kInstalledRelease)};
  if (const std::string problem = note_switch(); !problem.empty()) {
    perform(transaction_.node("the switch cannot be noted: " + problem, {}, rt::MonoClock::now()),
            rt::MonoClock::now());
    return;
  }
  leaving_ = true;
  process_.hold(fmt::format("the platform is being updated to release {}", version_of(order.deployment)));
}

void PlatformUpdate::leave() {
  const std::string problem = become_launcher(running_, state_.folder());
  leaving_ = false;
  log_.error("the installed agent cannot be started: {}", problem);
  perform(transaction_.node("the installed agent cannot be started: " + problem, {}, rt::MonoClock::now()),
          rt::MonoClock::now());
  process_.release();
}

void PlatformUpdate::commit(const Order& order) {
  Committed next = state_.committed();
  const std::string before = current_of(next);
  next.previous = before != order.deployment ? before : next.previous;
  next.current = order.deployment;
  next.current_size = order.size;
  next.generation = order.generation;
  next.grant = order.grant;
  next.plant = order.plant;
  next.members = order.boards;
  next.comment = version_of(order.deployment);
  next.history.push_back(
      {order.deployment, order.plant, order.generation, order.host, rt::wall_ns(), "committed", next.comment});
  if (const auto committed = state_.commit(std::move(next)); !committed) {
    log_.error("release {} runs but cannot be committed: {}", title_of(order.deployment), committed.error().text);
    return;
  }
  ::alarm(0);
  state_.collect_garbage();
  log_.info("release {}: committed", title_of(order.deployment));
}

void PlatformUpdate::go_back(const Order& order) {
  log_.error("release {}: rolling back: {}", title_of(order.deployment), transaction_.message());
  last_->ended = transaction_.message();
  (void)note_switch();
  Committed same = state_.committed();
  same.history.push_back({order.deployment, order.plant, order.generation, order.host, rt::wall_ns(),
                          "rolled back: " + transaction_.message(), version_of(order.deployment)});
  (void)state_.commit(std::move(same));
  if (running_.id == current_of(state_.committed())) {
    process_.release();  // this process has not become the other release yet
    return;
  }
  leaving_ = true;
  process_.hold("the platform goes back to release " + version_of(current_of(state_.committed())));
}

std::string PlatformUpdate::message() const {
  const std::string current = current_of(state_.committed());
  const Order& order = transaction_.order();
  const bool steady = transaction_.phase() == Phase::Steady;
  if (steady && leaving_) {
    return fmt::format("going back from release {} to {}: {}", version(), title_of(current), last_->ended);
  }
  if (steady && running_.id != current) {
    return fmt::format("release {} {}; {} runs", title_of(current), kCannotBeRun, version());
  }
  if (steady && last_ && !last_->ended.empty()) {
    return fmt::format("release {} was rolled back: {}", title_of(last_->order.deployment), last_->ended);
  }
  const bool trial = transaction_.phase() == Phase::Trial || transaction_.phase() == Phase::Healthy;
  if (trial && !leaving_ && transaction_.message().empty() && stood_.count() > 0) {
    return fmt::format("its node stood for {:.1f} s", std::chrono::duration<double>(stood_).count());
  }
  return steady && order.deployment == current ? std::string() : transaction_.message();
}

BoardReport PlatformUpdate::report() const {
  const Committed& committed = state_.committed();
  const Order& order = transaction_.order();
  BoardReport out;
  static_cast<CommittedDeployment&>(out) = static_cast<const CommittedDeployment&>(committed);
  static_cast<FetchProgress&>(out) = fetcher_.progress();
  out.generation = generation();
  out.current = current_of(committed);
  out.comment = version_of(out.current);
  out.plant = plant_.plant;
  out.members = plant_.members;
  out.board = board_;
  out.agent = self_;
  out.host = host_;
  out.release = version();
  out.deployer = order.deployer;
  out.deployer_host = order.host;
  out.proposed = order.deployment;
  out.phase = transaction_.phase();
  out.stage = transaction_.stage();
  out.refused = refused_;
  out.refusal = refusal_;
  out.message = message();
  out.node = process_.condition();
  out.clock_offset_ns = transaction_.clock_offset().count();
  return out;
}

}  // namespace indurop::deploy
