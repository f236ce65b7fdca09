// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/agent.h"

#include "core/base/exit_code.h"
#include "core/base/program_folder.h"
#include "core/base/stop_signal.h"
#include "core/rt/clock.h"
#include "deploy/agent/agent_state.h"
#include "deploy/agent/board_alarms.h"
#include "deploy/agent/board_change.h"
#include "deploy/agent/board_commands.h"
#include "deploy/agent/board_deployment.h"
#include "deploy/agent/board_link.h"
#include "deploy/agent/board_pools.h"
#include "deploy/agent/board_process.h"
#include "deploy/agent/board_recorder.h"
#include "deploy/agent/board_verify.h"
#include "deploy/agent/both_clocks.h"
#include "deploy/agent/deploy_keys.h"
#include "deploy/agent/fetcher.h"
#include "deploy/agent/offer.h"
#include "deploy/agent/order_gate.h"
#include "deploy/agent/other_boards.h"
#include "deploy/agent/platform_update.h"
#include "deploy/agent/report_schedule.h"
#include "deploy/agent/service_manager.h"
#include "deploy/link/blob_server.h"
#include "deploy/transaction/board_transaction.h"
#include "store/vars/box_request.h"

namespace indurop::deploy {
namespace {

using Do = BoardTransaction::Do;

constexpr std::chrono::milliseconds kAgentPoll{20};

// Returns the result as the transaction expects it: empty is success.
std::string text_of(const Result<void, base::Problem>& result) {
  return result ? std::string{} : result.error().text;
}

class Agent {
 public:
  Agent(const AgentOptions& options, const base::Log& log, AgentState& state, AgentState& platform,
        const RunningRelease& running)
      : options_(options),
        log_(log),
        state_(state),
        self_(continued_session(platform) != 0 ? continued_session(platform) : new_session()),
        keys_(options.board),
        deployment_(state, options.board, options.link.network.one_host),
        transaction_(options.board),
        gate_(state, keys_, deployment_, transaction_, log),
        fetcher_(state, self_, options.board),
        process_(
            options.board, node_arguments(options), {state.folder() / "blackbox", options.board},
            [this](const std::string& id) { return verify(id); }, log),
        change_(state, options.board, deployment_, process_, log),
        pools_(options.board, pools_program(), pools_arguments(options), options.link.network.one_host, {}, log),
        recorder_(options.board, base::program_folder() / "indurop", {}, log),
        alarms_(options.board, log),
        board_commands_(options.board, self_, keys_, state, process_, recorder_, log),
        values_(options.board),
        verify_(state),
        server_(
            self_,
            [this](const std::string& name) {
              return offer(name, {options_.board, state_, values_, verify_, pools_, board_commands_.users(), keys_});
            }),
        net_(link_settings(options, self_), keys_, log),
        others_(options.board, self_, board_commands_.users(), keys_, log),
        platform_(options.board, self_, running, platform, keys_, process_, log) {}

  int run(base::StopSignal& signals) {
    change_.resume();
    state_.collect_old_garbage();
    resume();
    service_manager_.ready();
    while (signals.wait({}) == 0) {
      const rt::MonoTime now = rt::MonoClock::now();
      service_manager_.alive(now);
      process_.step(now);
      pools_.step(process_.to_run(), process_.runs_it(), now);
      recorder_.step(now);
      alarms_.step(now);
      connect(now);
      if (net_.link() != nullptr) {
        listen(now);
        work(now);
        send_report(now);
      }
      follow(now);
      platform_.step(net_.platform(), state_.committed(), transaction_.phase() == Phase::Steady, now);
      if (platform_.leaves()) {
        net_.leave();
        pools_.end();
        platform_.leave();
      }
      pause(signals);
    }
    log_.info("stopping: signal {}", signals.received());
    service_manager_.stopping();
    net_.leave();  // the other boards see at once that this board leaves
    pools_.end();
    process_.end();
    return signals.received() == SIGINT ? kInterrupted : kOk;
  }

 private:
  // Runs the last committed deployment, without any network.
  void resume() {
    const Committed& committed = state_.committed();
    if (committed.current.empty()) {
      log_.info("board {}: nothing is deployed yet", options_.board);
      return;
    }
    if (!deployment_.belongs(committed.members)) {
      log_.info("board {}: no longer part of plant {}", options_.board, committed.plant);
      return;
    }
    log_.info("board {}: resuming deployment {} of plant {}", options_.board, shown_id(committed.current),
              committed.plant);
    note_damage(text_of(state_.repair(committed.current)));
    process_.want(deployment_.manifest(committed.current), committed.current);
  }

  // Damage of the committed deployment. What this board cannot restore on its own it fetches from another one, see
  // listen().
  void note_damage(const std::string& problem) {
    damaged_ = !problem.empty();
    if (damaged_) {
      log_.error("the committed deployment is damaged: {}", problem);
    }
  }

  std::string verify(const std::string& id) {
    std::string problem = text_of(deployment_.verify(id));
    damaged_ = damaged_ || (!problem.empty() && id == state_.committed().current);
    return problem;
  }

  void connect(rt::MonoTime now) {
    const bool idle = transaction_.phase() == Phase::Steady && !fetcher_.active() && !busy_ && !platform_.under_way();
    if (net_.keep(now, state_.committed().plant, idle)) {
      others_.clear();
      report_schedule_.request();
    }
  }

  void listen(rt::MonoTime now) {
    for (const auto& news : net_.link()->take_orders()) {
      const std::uint64_t refused = gate_.refused();
      if (!news.gone && gate_.accepts(news.order, platform_.under_way())) {  // a deployer that is gone sends nothing
        const BothClocks clocks = both_clocks();
        perform(transaction_.receive(news.order, clocks.mono, clocks.wall), now);
      }
      if (gate_.refused() != refused) {
        report_schedule_.request();
      }
    }
    for (const std::string& why : others_.listen(*net_.link(), state_.committed().plant)) {
      keep_box(why);
    }
    // What is valid first: a deployment that was missed may be that of a deployer who was revoked meanwhile.
    const bool knows = !net_.has_keys() || others_.know_lists(listed_plant());
    for (const auto& [key, other] : others_.all()) {
      if (knows && deployment_.lacks(other, damaged_) && !platform_.under_way() &&
          keys_.refusal(other.plant, grant_text(other.plant, other.current, other.generation), other.grant).empty()) {
        perform(transaction_.catch_up(other, now, Way::Exchange), now);
      }
    }
  }

  // A deployment ends nodes; that is no fault.
  void keep_box(const std::string& why) {
    if (transaction_.phase() == Phase::Steady && process_.condition() == NodeCondition::Running) {
      log_.info("{}: the black box of this board is also kept", why);
      if (const Status requested = vars::request_box(options_.board, why); !requested) {
        log_.warning("the black box cannot be kept: {}", requested.error().where);
      }
    }
  }

  // The plant whose lists this board takes; also before anything is deployed to it.
  [[nodiscard]] const std::string& listed_plant() const {
    return state_.committed().plant.empty() ? net_.plant() : state_.committed().plant;
  }

  void work(rt::MonoTime now) {
    if (board_commands_.step(*net_.commands(), *net_.link(), state_.committed().plant,
                             platform_.under_way()                   ? "its platform is being updated"
                             : transaction_.phase() == Phase::Steady ? ""
                                                                     : "a deployment is under way",
                             now)) {
      values_.forget();  // the user who has set something sees it at once
    }
    if (fetcher_.active()) {
      const Fetcher::State state = fetcher_.step(*net_.link(), now);
      if (state == Fetcher::State::Done) {
        perform(transaction_.fetched({}), now);
      } else if (state == Fetcher::State::Failed) {
        perform(transaction_.fetched(fetcher_.problem()), now);
      }
    } else {
      others_.step_lists(*net_.link(), listed_plant(), now);
    }
    busy_ = server_.serve(*net_.link(), now);
    if (const auto problem = verify_.step()) {
      note_damage(*problem);
    }
    busy_ = busy_ || verify_.busy();
  }

  void follow(rt::MonoTime now) {
    if (const auto answer = change_.poll(transaction_.order())) {
      report_schedule_.request();
      perform(answer->what == BoardExchange::Done::Loaded ? transaction_.loaded(answer->problem, answer->exchanges, now)
              : answer->what == BoardExchange::Done::Entered ? transaction_.exchanged(answer->problem, now)
                                                             : Do::Nothing,
              now);
    }
    perform(transaction_.time(now), now);
    const Phase phase = transaction_.phase();
    if (phase == Phase::Trial || phase == Phase::Healthy) {
      const BoardProcess::Health health = change_.health(transaction_.order());
      perform(transaction_.node(health.problem, health.missing, now), now);
    }
  }

  void perform(Do what, rt::MonoTime now) {
    const Order& order = transaction_.order();
    switch (what) {
      case Do::Nothing:
        return;
      case Do::Fetch:
        log_.info("deployment {} of {}: fetching", shown_id(order.deployment), order.host);
        change_.begin();
        fetcher_.begin(others_.with_files_of(order.plant, transaction_.source()), order.deployment, order.size);
        break;
      case Do::Check:
        report_schedule_.request();
        send_report(now);  // it may take a while
        perform(transaction_.checked(text_of(deployment_.check(order)), rt::MonoClock::now()), rt::MonoClock::now());
        break;
      case Do::Load:
        change_.load(order);
        break;
      case Do::Enter:
        change_.enter(order, transaction_.switch_at(), transaction_.joining());
        break;
      case Do::Switch:
        change_.restart(order);
        break;
      case Do::Commit:
        change_.commit(order);
        commit(order);
        break;
      case Do::GoBack:
        log_.error("deployment {}: rolling back: {}", shown_id(order.deployment), transaction_.message());
        go_back(order);
        break;
      case Do::Forget:
        fetcher_.cancel();
        change_.forget();
        if (!transaction_.message().empty()) {
          log_.warning("deployment {}: abandoned: {}", shown_id(order.deployment), transaction_.message());
        }
        state_.collect_garbage(order.deployment);
        break;
    }
    report_schedule_.request();
  }

  void commit(const Order& order) {
    damaged_ = false;
    if (const auto committed = deployment_.commit(order); committed) {
      log_.info("deployment {}: committed", shown_id(order.deployment));
    } else {
      log_.error("deployment {} runs but cannot be committed: {}", shown_id(order.deployment), committed.error().text);
    }
  }

  void go_back(const Order& order) {
    change_.go_back(transaction_.way());
    if (const auto noted = deployment_.note_rollback(order, transaction_.message()); !noted) {
      log_.error("{}", noted.error().text);
    }
    state_.collect_garbage();
  }

  BoardReport report() {
    const Committed& committed = state_.committed();
    const Order& order = transaction_.order();
    BoardReport out;
    static_cast<CommittedDeployment&>(out) = static_cast<const CommittedDeployment&>(committed);
    static_cast<FetchProgress&>(out) = fetcher_.progress();
    static_cast<NodeFigures&>(out) = process_.figures();
    out.board = options_.board;
    out.agent = self_;
    out.host = host_name();
    out.release = platform_.version();
    out.deployer = order.deployer;
    out.deployer_host = order.host;
    out.proposed = order.deployment;
    out.phase = transaction_.phase();
    out.stage = transaction_.stage();
    out.refused = gate_.refused();
    out.refusal = gate_.reason();
    out.message = transaction_.message();
    if (!out.message.empty() && out.phase == Phase::Steady && order.deployment != committed.current) {
      out.message = fmt::format("deployment {} was rolled back: {}", shown_id(order.deployment), out.message);
    }
    if (out.message.empty() && process_.condition() != NodeCondition::Running) {
      out.message = process_.reason();
    }
    if (out.message.empty()) {
      out.message = pools_.problem();
    }
    if (out.message.empty() && !committed.current.empty() && !deployment_.belongs(committed.members)) {
      out.message = fmt::format("no longer part of plant {}", committed.plant);
    }
    out.node = process_.condition();
    out.clock_offset_ns = transaction_.clock_offset().count();
    out.way = transaction_.way();
    out.grid_ns = change_.grid_ns();
    out.plan = out.phase == Phase::Steady ? "" : change_.plan();
    return out;
  }

  void send_report(rt::MonoTime now) {
    if (net_.link() != nullptr &&
        report_schedule_.take_due(transaction_.phase(), process_.condition(), process_.figures().faults, now)) {
      net_.link()->publish(report());
    }
  }

  void pause(base::StopSignal& signals) {
    if (net_.link() == nullptr) {
      signals.wait(kAgentPoll);
    } else if (!busy_) {
      net_.link()->wait(rt::MonoClock::now() + kAgentPoll);
    }
  }

  const AgentOptions& options_;
  const base::Log& log_;
  AgentState& state_;
  std::uint64_t self_;
  DeployKeys keys_;
  BoardDeployment deployment_;
  BoardTransaction transaction_;
  OrderGate gate_;
  Fetcher fetcher_;
  BoardProcess process_;
  BoardChange change_;
  BoardPools pools_;
  BoardRecorder recorder_;
  BoardAlarms alarms_;
  BoardCommands board_commands_;
  BoardValues values_;
  BoardVerify verify_;
  BlobServer server_;
  ServiceManager service_manager_;
  BoardLink net_;
  OtherBoards others_;
  PlatformUpdate platform_;
  bool damaged_ = false;  // the committed deployment is damaged, and this board cannot restore it on its own
  bool busy_ = false;
  ReportSchedule report_schedule_;
};

}  // namespace

int run_agent(const AgentOptions& options, char** arguments) {
  const base::Log log("indurop-agent", options.board, options.quiet,
                      options.journal ? std::make_shared<const base::Journal>() : nullptr);
  const RunningRelease running = become_release(options.board, arguments, log);
  base::StopSignal signals;
  auto state = AgentState::open(options.board, [&log](const std::string& line) { log.error("{}", line); });
  if (!state) {
    log.error("{}", state.error().text);
    return kFailed;
  }
  auto platform = AgentState::open_platform(options.board, [&log](const std::string& line) { log.error("{}", line); });
  if (!platform) {
    log.error("{}", platform.error().text);
    return kFailed;
  }
  return Agent(options, log, *state, *platform, running).run(signals);
}

}  // namespace indurop::deploy
