// SPDX-License-Identifier: Apache-2.0
#include "node/agent.h"

#include <algorithm>
#include <map>
#include <memory>
#include <set>

#include "deploy/board_transaction.h"
#include "mirror/blob_server.h"
#include "node/agent_state.h"
#include "node/board_deployment.h"
#include "node/board_orders.h"
#include "node/board_process.h"
#include "node/deploy_keys.h"
#include "node/fetcher.h"
#include "node/mirror_text.h"
#include "node/stop_signal.h"
#include "rt/clock.h"
#include "schema/topic_name.h"

namespace indurop::node {
namespace {

using deploy::BoardTransaction;
using Do = BoardTransaction::Do;

constexpr std::int64_t kLookNs = 20'000'000;
constexpr std::int64_t kTellNs = 500'000'000;  // at least
constexpr std::int64_t kTellFastNs = 50'000'000;
constexpr std::size_t kOthersTold = 32;  // then it may be somebody who invents them
constexpr std::int64_t kNetworkRetryNs = 1'000'000'000;

std::vector<std::string> node_arguments(const Options& options) {
  std::vector<std::string> words;
  if (options.one_host) {
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
  return words;
}

class Agent {
 public:
  Agent(const Options& options, Console& console, AgentState& state)
      : options_(options),
        console_(console),
        state_(state),
        self_(mirror::new_session()),
        keys_(options.board),
        deployment_(state, options.board, options.one_host),
        transaction_(options.board),
        fetcher_(state, self_, options.board),
        process_(options.board, node_arguments(options), console),
        orders_(options.board, self_, keys_, process_, console),
        server_(self_, [this](const std::string& name, mirror::BlobServer::Blob& blob) { return find(name, blob); }) {
    link_settings_.domain = options.domain.value_or(mirror::LinkSettings::kDefaultDomain);
    link_settings_.interface_name = options.interface_name;
    link_settings_.one_host = options.one_host;
    link_settings_.self = self_;
    link_settings_.board = options.board;
    host_ = mirror::host_name();
  }

  int run(StopSignal& signals) {
    resume();
    while (signals.wait(0) == 0) {
      const std::int64_t now = rt::now_ns();
      process_.step(now);
      connect(now);
      if (link_ != nullptr) {
        listen(now);
        work(now);
        tell(now);
      }
      follow(now);
      pause(signals);
    }
    console_.info("stopping: signal {}", signals.received());
    commands_.reset();
    link_.reset();  // the others see at once that this board leaves
    process_.end();
    return signals.received() == SIGINT ? kInterrupted : kOk;
  }

 private:
  // The last committed deployment, without any network.
  void resume() {
    const Committed& committed = state_.committed();
    if (committed.current.empty()) {
      console_.info("board {}: nothing is deployed yet", options_.board);
      return;
    }
    if (!deployment_.belongs(committed.members)) {
      console_.info("board {}: not part of plant {} any more", options_.board, committed.plant);
      return;
    }
    std::string problem = state_.install(committed.current);
    if (problem.empty()) {
      console_.info("board {}: resuming deployment {} of plant {}", options_.board, deploy::shown_id(committed.current),
                    committed.plant);
      process_.want(state_.manifest(committed.current), committed.current);
    } else {
      console_.error("the committed deployment cannot be resumed: {}", problem);
    }
  }

  bool find(const std::string& name, mirror::BlobServer::Blob& blob) const {
    if (name == deploy::kHistoryBlob || name == deploy::kMirrorBlob) {
      blob.text = name == deploy::kHistoryBlob ? state_.history_text() : mirror_text(options_.board);
      return true;
    }
    blob.file = state_.file(name);
    return state_.has(name);
  }

  void connect(std::int64_t now) {
    if (link_ != nullptr || now < connect_ns_) {
      return;
    }
    connect_ns_ = now + kNetworkRetryNs;
    std::string problem;
    link_ = mirror::DeployLink::open(link_settings_, problem);
    if (link_ != nullptr) {
      std::string failed;
      commands_ = mirror::CommandLink::open(*link_, mirror::CommandSide::Agent, failed);
      if (commands_ == nullptr) {
        problem = failed;
        link_.reset();
      }
    }
    if (!problem.empty() && problem != network_problem_) {
      console_.warning("{}", problem);
    }
    network_problem_ = problem;
  }

  void listen(std::int64_t now) {
    for (const auto& news : link_->take_orders()) {
      if (news.gone) {
        perform(transaction_.deployer_gone(news.order.deployer), now);
      } else if (may_order(news.order)) {
        perform(transaction_.hear(news.order, now, rt::wall_ns()), now);
      }
    }
    for (auto& news : link_->take_boards()) {
      const auto key = std::pair(news.report.board, news.report.agent);
      if (news.gone) {
        others_.erase(key);
      } else {
        others_[key] = std::move(news.report);
      }
    }
    for (const deploy::OtherAgent& other : link_->other_agents()) {
      if (told_others_.size() < kOthersTold && told_others_.insert(other.host + "/" + other.board).second) {
        console_.warning("{}", deploy::describe(other, schema::protocol()));
      }
    }
    for (const auto& [key, other] : others_) {
      // It missed a deployment of its plant, which may be the one that leaves it out.
      const bool dropped = other.plant == state_.committed().plant && deployment_.belongs(state_.committed().members);
      const bool complete =
          std::find(other.members.begin(), other.members.end(), key.first) != other.members.end();  // has all files
      if (key.first != options_.board && complete && (deployment_.belongs(other.members) || dropped) &&
          other.generation > state_.committed().generation &&
          keys_.refusal(other.plant, deploy::grant_text(other.plant, other.current, other.generation), other.grant)
              .empty()) {
        perform(transaction_.catch_up(other, now), now);
      }
    }
  }

  // Orders meant for this board are taken from who may deploy to it; others are told why not.
  bool may_order(const deploy::Order& order) {
    if (!deployment_.belongs(order.boards)) {
      return false;
    }
    std::string why = keys_.refusal(order.plant, deploy::order_text(order), order.signature);
    if (why.empty()) {
      why =
          keys_.refusal(order.plant, deploy::grant_text(order.plant, order.deployment, order.generation), order.grant);
    }
    const bool begins = order.step == deploy::Step::Prepare && transaction_.phase() == deploy::Phase::Steady;
    if (why.empty() && begins && order.generation <= state_.committed().generation &&
        order.deployer != transaction_.order().deployer) {
      why = "this board has a newer deployment than that; deploy again";
    }
    if (!why.empty() && order.step == deploy::Step::Prepare && refused_ != order.deployer) {
      console_.warning("an order of {} was refused: {}", order.host, why);
      refused_ = order.deployer;
      refusal_ = why;
      tell_now_ = true;
    }
    return why.empty();
  }

  void work(std::int64_t now) {
    orders_.step(*commands_, state_.committed().plant,
                 transaction_.phase() == deploy::Phase::Steady ? "" : "a deployment is under way", now);
    if (fetcher_.active()) {
      const Fetcher::Result result = fetcher_.step(*link_, now);
      if (result == Fetcher::Result::Done) {
        perform(transaction_.fetched({}), now);
      } else if (result == Fetcher::Result::Failed) {
        perform(transaction_.fetched(fetcher_.problem()), now);
      }
    } else {
      (void)link_->take_chunks();
    }
    busy_ = server_.serve(*link_, now);
  }

  void follow(std::int64_t now) {
    perform(transaction_.time(now), now);
    const deploy::Phase phase = transaction_.phase();
    if (phase == deploy::Phase::Trial || phase == deploy::Phase::Healthy) {
      const BoardProcess::Health health = process_.health(transaction_.order().boards);
      perform(transaction_.node(health.problem, health.missing, now), now);
    }
  }

  void perform(Do what, std::int64_t now) {
    const deploy::Order& order = transaction_.order();
    switch (what) {
      case Do::Nothing:
        return;
      case Do::Fetch:
        console_.info("deployment {} of {}: fetching", deploy::shown_id(order.deployment), order.host);
        fetcher_.begin(transaction_.source(), order.deployment, order.size);
        break;
      case Do::Check:
        tell_now_ = true;
        tell(now);  // it may take a while
        perform(transaction_.checked(deployment_.check(order), rt::now_ns()), rt::now_ns());
        break;
      case Do::Switch:
        console_.info("deployment {}: switching", deploy::shown_id(order.deployment));
        held_before_ = process_.held();
        process_.want(deployment_.manifest(order.deployment), order.deployment);
        break;
      case Do::Commit:
        commit(order);
        break;
      case Do::GoBack:
        console_.error("deployment {}: going back: {}", deploy::shown_id(order.deployment), transaction_.message());
        go_back(order);
        break;
      case Do::Forget:
        fetcher_.cancel();
        console_.warning("deployment {}: given up: {}", deploy::shown_id(order.deployment), transaction_.message());
        break;
    }
    tell_now_ = true;
  }

  void commit(const deploy::Order& order) {
    const std::string problem = deployment_.commit(order);
    if (problem.empty()) {
      console_.info("deployment {}: committed", deploy::shown_id(order.deployment));
    } else {
      console_.error("deployment {} runs but cannot be committed: {}", deploy::shown_id(order.deployment), problem);
    }
  }

  void go_back(const deploy::Order& order) {
    const std::string& before = state_.committed().current;
    process_.want(deployment_.manifest(before), before);
    if (!held_before_.empty()) {
      process_.hold(held_before_);
    }
    if (const std::string problem = deployment_.note_rollback(order, transaction_.message()); !problem.empty()) {
      console_.error("{}", problem);
    }
  }

  deploy::BoardReport report() {
    const Committed& committed = state_.committed();
    const deploy::Order& order = transaction_.order();
    const BoardProcess::Figures figures = process_.figures();
    deploy::BoardReport out;
    out.board = options_.board;
    out.agent = self_;
    out.host = host_;
    out.release = INDUROP_VERSION;
    out.generation = committed.generation;
    out.plant = committed.plant;
    out.current = committed.current;
    out.current_size = committed.current_size;
    out.previous = committed.previous;
    out.members = committed.members;
    out.deployer = order.deployer;
    out.deployer_host = order.host;
    out.proposed = order.deployment;
    out.phase = transaction_.phase();
    out.stage = transaction_.stage();
    out.files = fetcher_.files();
    out.files_done = fetcher_.files_done();
    out.bytes = fetcher_.bytes();
    out.bytes_done = fetcher_.bytes_done();
    out.grant = committed.grant;
    out.refused = refused_;
    out.refusal = refusal_;
    out.message = transaction_.message();
    if (out.message.empty() && process_.condition() != deploy::NodeCondition::Running) {
      out.message = process_.reason();
    }
    if (out.message.empty() && !committed.current.empty() && !deployment_.belongs(committed.members)) {
      out.message = fmt::format("not part of plant {} any more", committed.plant);
    }
    out.node = process_.condition();
    out.tick = figures.tick;
    out.lost_ticks = figures.lost_ticks;
    out.overruns = figures.overruns;
    out.faults = figures.faults;
    out.clock_offset_ns = transaction_.clock_offset_ns();
    return out;
  }

  void tell(std::int64_t now) {
    const bool moving = transaction_.phase() != deploy::Phase::Steady || process_.condition() != told_node_;
    if (link_ == nullptr || (!tell_now_ && now - told_ns_ < (moving ? kTellFastNs : kTellNs))) {
      return;
    }
    told_ns_ = now;
    tell_now_ = false;
    told_node_ = process_.condition();
    link_->publish(report());
  }

  void pause(StopSignal& signals) {
    if (link_ == nullptr) {
      signals.wait(kLookNs);
    } else if (!busy_) {
      link_->wait(rt::now_ns() + kLookNs);
    }
  }

  const Options& options_;
  Console& console_;
  AgentState& state_;
  std::uint64_t self_;
  std::string host_;
  DeployKeys keys_;
  BoardDeployment deployment_;
  BoardTransaction transaction_;
  Fetcher fetcher_;
  BoardProcess process_;
  std::string held_before_;  // the trial
  BoardOrders orders_;
  mirror::BlobServer server_;
  mirror::LinkSettings link_settings_;
  std::unique_ptr<mirror::DeployLink> link_;
  std::unique_ptr<mirror::CommandLink> commands_;
  std::int64_t connect_ns_ = 0;
  std::string network_problem_;
  std::map<std::pair<std::string, std::uint64_t>, deploy::BoardReport> others_;
  std::set<std::string> told_others_;  // agents of other releases
  std::uint64_t refused_ = 0;
  std::string refusal_;
  bool busy_ = false;
  bool tell_now_ = true;
  std::int64_t told_ns_ = 0;
  deploy::NodeCondition told_node_ = deploy::NodeCondition::None;
};

}  // namespace

int run_agent(const Options& options) {
  StopSignal signals;
  Console console(options.board + "-agent", options.quiet);
  std::string problem;
  auto state = AgentState::open(options.board, problem);
  if (!state) {
    console.error("{}", problem);
    return kFailed;
  }
  return Agent(options, console, *state).run(signals);
}

}  // namespace indurop::node
