// SPDX-License-Identifier: Apache-2.0
#include "node/node.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <set>

#include "deploy/reader.h"
#include "node/plant_part.h"
#include "node/report.h"
#include "node/setup.h"
#include "rt/clock.h"
#include "rt/guard.h"
#include "runtime/host.h"
#include "vars/process.h"

namespace indurop::node {
namespace {

using scheduler::ModuleState;
using scheduler::ModuleType;
using scheduler::Operation;

constexpr std::int64_t kLookNs = 10'000'000;
constexpr std::int64_t kEnrolNs = 500'000'000;  // how long the first tick waits for process modules

template <std::size_t N>
void copy_text(char (&to)[N], std::string_view from) {
  const std::size_t n = std::min(from.size(), N - 1);
  std::memcpy(to, from.data(), n);
  to[n] = '\0';
}

std::string describe(const Error& error) {
  return error.sys_errno != 0 ? fmt::format("{}: {}", error.where, std::strerror(error.sys_errno))
                              : fmt::format("{}: {}", error.where, to_string(error.code));
}

scheduler::SpinSettings to_spin(const deploy::SpinSetting& setting) {
  switch (setting.mode) {
    case deploy::SpinSetting::Mode::Off:
      return {scheduler::SpinMode::Off, 0};
    case deploy::SpinSetting::Mode::Fixed:
      return {scheduler::SpinMode::Fixed, setting.fixed.count()};
    case deploy::SpinSetting::Mode::Auto:
      break;
  }
  return {};
}

bool ended_well(const std::string& node) {
  const auto file = vars::RunFile::open(node, vars::Mode::ReadOnly, scheduler::kRunMagic, sizeof(scheduler::RunBlock));
  return file.ok() &&
         static_cast<const scheduler::RunBlock*>(file.value().data())->state.load() == scheduler::NodeState::Stopped;
}

}  // namespace

Node::Node(Options options) : options_(std::move(options)), console_(options_.node, options_.quiet) {}

Node::~Node() {
  engine_.reset();
  processes_.reset();
  runtime::detach_process();
  if (leave_nothing_) {
    store_.reset();
    run_file_.reset();
    lock_.reset();
    (void)vars::remove_node(options_.node);  // busy: somebody has just taken the name over
  }
}

int Node::run() {
  rt::install_guard_handlers();
  const bool ready = check() && claim_name() && obtain_rights() && make_memory() && load_modules() && start_modules() &&
                     start_schedule();
  if (ready) {
    supervise();
  }
  shut_down();
  return finish();
}

bool Node::fail(int code) {
  exit_ = code;
  return false;
}

bool Node::interrupted() {
  const int number = signals_.wait(0);
  if (number == 0) {
    return false;
  }
  reason_ = fmt::format("signal {}", ::strsignal(number));
  exit_ = number == SIGINT ? kInterrupted : kOk;
  return true;
}

bool Node::check() {
  const bool plant = deploy::is_plant_file(options_.config);
  if (plant == options_.board.empty()) {
    console_.error("{} {}", options_.config.string(),
                   plant ? "is the manifest of a plant: say with --board NAME which of its boards this is"
                         : "is not the manifest of a plant, so there is no --board");
    return fail(kUsage);
  }
  std::vector<deploy::Diagnostic> diagnostics;
  const bool ok = plant ? read_plant(diagnostics) : read_modules(diagnostics);
  for (const deploy::Diagnostic& diagnostic : diagnostics) {
    // Where all boards are on one host, whoever starts them says warnings once.
    const bool said = diagnostic.severity == deploy::Diagnostic::Severity::Note ||
                      (options_.one_host && diagnostic.severity == deploy::Diagnostic::Severity::Warning);
    if (!said) {
      fmt::print(stderr, "{}\n", deploy::to_string(diagnostic));
    }
  }
  if (ok && plant && !mirror_settings_) {
    console_.error("the plant has no board {}; it has {}", options_.board, fmt::join(board_names_, ", "));
    return fail(kUsage);
  }
  return ok || fail(kCheckFailed);
}

bool Node::read_modules(std::vector<deploy::Diagnostic>& diagnostics) {
  deploy::ReadResult read = deploy::read_config(options_.config);
  diagnostics = read.diagnostics;
  if (!read.ok()) {
    return false;
  }
  config_ = std::move(read.config);
  check_ = deploy::check_config(config_, {true, options_.adjust});
  diagnostics.insert(diagnostics.end(), check_.diagnostics.begin(), check_.diagnostics.end());
  external_.configure(config_, check_);
  return check_.ok();
}

bool Node::read_plant(std::vector<deploy::Diagnostic>& diagnostics) {
  deploy::ReadPlant read = deploy::read_plant(options_.config);
  diagnostics = read.diagnostics;
  if (!read.ok()) {
    return false;
  }
  deploy::Plant& plant = read.plant;
  deploy::PlantCheck checked = deploy::check_plant(plant, {true, options_.adjust, true, options_.board});
  diagnostics.insert(diagnostics.end(), checked.diagnostics.begin(), checked.diagnostics.end());
  for (std::size_t i = 0; i < plant.boards.size(); ++i) {
    board_names_.push_back(plant.boards[i].name);
    if (plant.boards[i].name == options_.board) {
      mirror_settings_ = mirror_settings(plant, checked, i);
      mirror_settings_->one_host = options_.one_host;
      external_.configure(plant, checked, i, options_.one_host);
      config_ = std::move(plant.boards[i].config);
      check_ = std::move(checked.boards[i]);
    }
  }
  return checked.ok();
}

bool Node::claim_name() {
  pid_t holder = 0;
  auto lock = vars::NodeLock::acquire(options_.node, holder);
  if (!lock) {
    if (lock.error().code == Errc::Busy) {
      console_.error(
          "a node of this name is already running{}; stop it with `indurop stop --node {}` or choose another "
          "name with --node",
          holder > 0 ? fmt::format(" (pid {})", holder) : "", options_.node);
    } else {
      console_.error("{}; choose another name with --node, or let their owner remove /dev/shm/indurop.{}*",
                     describe(lock.error()), options_.node);
    }
    return fail(kFailed);
  }
  lock_ = std::move(lock).value();
  const auto known = vars::list_nodes();
  leave_nothing_ = std::find(known.begin(), known.end(), options_.node) == known.end();
  return !interrupted();
}

bool Node::obtain_rights() {
  const auto cores = rt::allowed_cores();
  core_ = cores.empty() ? 0 : cores.back();
  if (options_.core || config_.core >= 0) {
    core_ = options_.core.value_or(config_.core);
    if (std::find(cores.begin(), cores.end(), core_) == cores.end()) {
      console_.error("core {} cannot be used by this process; it may use {}", core_, fmt::join(cores, ", "));
      return fail(kUsage);
    }
  }
  const Status fifo = rt::set_fifo(scheduler::kTickPriority);
  obtained_.fifo = fifo.ok() ? 1 : 0;
  (void)rt::set_fifo(0);
  obtained_.tick_priority = fifo.ok() ? scheduler::kTickPriority : 0;
  obtained_.pinned = obtained_.fifo;
  obtained_.tick_core = fifo.ok() ? core_ : -1;
  if (auto idle = rt::ShortIdle::hold(); idle) {
    idle_ = std::move(idle).value();
    obtained_.cpu_dma_latency = 1;
  }
  obtained_.preempt_rt = rt::kernel_is_preempt_rt() ? 1 : 0;
  obtained_.throttle_permille = static_cast<std::uint32_t>(rt::throttle_permille());
  if (!fifo.ok()) {
    copy_text(obtained_.why,
              "SCHED_FIFO refused: run as root, or give the user rtprio 95 and memlock unlimited in "
              "/etc/security/limits.d, or the program CAP_SYS_NICE and CAP_IPC_LOCK");
    if (options_.require_rt) {
      console_.error("real-time rights not obtained (--require-rt): {}", obtained_.why);
      return fail(kNoRealTime);
    }
    console_.warning("NOT REAL TIME: {}. Order is kept, timing is best effort", obtained_.why);
  }
  return true;
}

bool Node::make_memory() {
  previous_run_ended_well_ = ended_well(options_.node);
  auto store = vars::Store::create(options_.node, check_.schema);
  if (!store) {
    console_.error(
        "cannot make the shared variables: {}{}", describe(store.error()),
        store.error().code == Errc::NoSpace ? "; free space in /dev/shm (`indurop clean`, `df /dev/shm`)" : "");
    return fail(kFailed);
  }
  store_ = std::move(store).value();
  setup_ = make_run_setup(config_, check_, options_.node, {core_, obtained_.fifo != 0});
  setup_.deployment = options_.deployment;
  auto file = vars::RunFile::create(options_.node, scheduler::run_block_size(setup_));
  if (!file) {
    console_.error(
        "cannot make the run's shared memory: {}{}", describe(file.error()),
        file.error().code == Errc::NoSpace ? "; free space in /dev/shm (`indurop clean`, `df /dev/shm`)" : "");
    return fail(kFailed);
  }
  run_file_ = std::move(file).value();
  run_ = static_cast<scheduler::RunBlock*>(run_file_->data());
  run_->node_pid.store(::getpid());
  run_->node_start_time = vars::process_start_time(::getpid());
  run_->started_wall_ns = rt::wall_ns();
  run_->obtained = obtained_;
  scheduler::init_run_block(*run_, setup_);
  if (!mirror_settings_) {
    (void)vars::remove_shm_file(vars::mirror_file(options_.node));  // of an earlier run as a board
  }
  failsafe_ = std::make_unique<FailSafe>(*store_, config_);
  retainer_ = std::make_unique<Retainer>(*store_, options_.node);
  if (store_->origin() == vars::Origin::Fresh) {
    retainer_->load(console_);
  } else if (previous_run_ended_well_) {
    store_->reset(true);  // an orderly new run begins with initial values; after a crash the values go on
  }
  console_.watch(*run_);
  return !interrupted();
}

bool Node::load_modules() {
  auto problems = runtime::attach_process(*store_, *run_);
  libraries_.resize(config_.modules.size());
  std::set<std::filesystem::path> loaded;
  bool ok = true;
  for (std::uint32_t i = 0; i < config_.modules.size(); ++i) {
    const deploy::Module& module = config_.modules[i];
    if (module.type != ModuleType::Thread) {
      continue;
    }
    std::string problem;
    runtime::set_current_module(i);
    if (!libraries_[i].load(module.file, !loaded.insert(module.file).second, problem)) {
      fmt::print(stderr, "{}\n",
                 deploy::to_string({deploy::Diagnostic::Severity::Error, config_.file.string(), module.place,
                                    fmt::format("module {}: {}", module.name, problem)}));
      ok = false;
    }
    runtime::set_current_module(runtime::kNoModule);
    if (module.operation == Operation::Sporadic && libraries_[i].functions().run != nullptr &&
        !libraries_[i].functions().condition) {
      console_.error("module {}: a sporadic thread module needs condition(): define `extern \"C\" int condition()`",
                     module.name);
      ok = false;
    }
  }
  if (!ok) {
    return fail(kCheckFailed);
  }
  const auto late = runtime::take_binding_errors();
  problems.insert(problems.end(), late.begin(), late.end());
  for (const std::string& problem : problems) {
    console_.error("{}", problem);
  }
  if (!problems.empty()) {
    return fail(kSchemaMismatch);
  }
  tasks_ = make_tasks(config_, setup_, core_);
  for (scheduler::Task& task : tasks_) {
    if (task.type == ModuleType::Thread) {
      task.run = libraries_[task.index].functions().run;
      if (task.operation == Operation::Sporadic) {
        task.condition = libraries_[task.index].functions().condition;
      }
    }
  }
  return !interrupted();
}

bool Node::start_modules() {
  scheduler::EngineSettings settings;
  settings.basic_period_ns = setup_.basic_period_ns;
  settings.primary_core = core_;
  settings.realtime = obtained_.fifo != 0;
  settings.spin = to_spin(options_.spin.value_or(config_.spin.value_or(deploy::SpinSetting{})));
  if (mirror_settings_) {
    // Boards with the same macro period begin it together, as far as their clocks agree. A long one is not waited for.
    settings.grid_ns = setup_.macro_period_ns <= rt::kNanosPerSecond ? setup_.macro_period_ns : setup_.basic_period_ns;
    settings.phase_ns = (rt::now_ns() - rt::wall_ns()) % settings.grid_ns;
  }
  engine_ = std::make_unique<scheduler::Engine>(*run_, tasks_, settings, hooks(), clock_);
  phases_ = std::make_unique<Phases>(config_, *run_, libraries_, console_, signals_, hooks());
  normal_threads_ = std::make_unique<NormalThreads>(config_, *run_, libraries_, hooks());
  leave_nothing_ = false;  // from here on there is something to look at
  const bool ok = phases_->call_all("start", &ModuleDescriptor::start);
  console_.report(rt::now_ns(), false);
  started_ = true;
  if (!ok && !interrupted()) {
    console_.error("a module could not be started: nothing was run");
    return fail(kFailed);
  }
  if (interrupted()) {
    return false;
  }
  const int service = obtained_.fifo != 0 ? scheduler::kServicePriority : 0;
  if (const Status served = runtime::start_function_servers(service, obtained_.fifo != 0 ? core_ : -1); !served) {
    console_.error("shared functions cannot be served: {}", describe(served.error()));
    return fail(kFailed);
  }
  processes_ = std::make_unique<Processes>(config_, *run_, options_.node, obtained_.fifo != 0, console_, *failsafe_);
  if (!processes_->launch_all()) {
    return fail(kFailed);
  }
  const std::int64_t patience = rt::now_ns() + kEnrolNs;
  while (!processes_->ready() && rt::now_ns() < patience) {
    signals_.wait(kLookNs / 10);
    if (processes_->supervise(rt::now_ns())) {
      stop_because(processes_->reason());
      return fail(kFailed);
    }
    console_.report(rt::now_ns(), false);
  }
  return !interrupted();
}

bool Node::start_schedule() {
  if (mirror_settings_) {
    name_writers(*mirror_settings_, config_, check_, *engine_);
  }
  check_ = {};  // not needed any more, and what is there now stays in memory
  store_->prefault();
  run_file_->prefault();
  // Used while starting, and by the threads that talk to other boards, which are not real-time.
  constexpr std::array<std::string_view, 5> kNotNeeded{"libddsc", "libcrypto", "libssl", "libiceoryx", "libtinyxml2"};
  if (const Status locked = rt::lock_memory(kNotNeeded); locked) {
    run_->obtained.memory_locked = 1;
  } else if (obtained_.fifo != 0) {
    copy_text(run_->obtained.why, "mlockall refused: raise the limit of locked memory (memlock unlimited)");
    if (options_.require_rt) {
      console_.error("real-time rights not obtained (--require-rt): {}", run_->obtained.why);
      return fail(kNoRealTime);
    }
    console_.warning("memory is not locked: {}", run_->obtained.why);
  }
  for (const scheduler::Task& task : tasks_) {
    if (task.type == ModuleType::Thread) {
      run_->modules()[task.index].state.store(ModuleState::Running);
    }
  }
  std::uint64_t ticks = 0;
  if (options_.duration) {
    ticks = static_cast<std::uint64_t>(
        std::max<std::int64_t>(1, (options_.duration->count() + setup_.basic_period_ns - 1) / setup_.basic_period_ns));
  }
  retainer_->start();
  if (!start_mirror()) {
    return false;
  }
  external_.start(options_.node, *store_, mirror_ ? &mirror_->block() : nullptr, cores_without_modules(), console_);
  if (const Status started = engine_->start(ticks); !started) {
    console_.error("cannot start the schedule: {}", describe(started.error()));
    return fail(kFailed);
  }
  if (mirror_) {
    mirror_->announce({run_->epoch_ns + rt::wall_ns() - rt::now_ns(), setup_.basic_period_ns, setup_.macro_period_ns});
  }
  normal_threads_->start();
  orders_ = std::make_unique<ModuleOrders>(ModuleOrders::Parts{config_, *run_, libraries_, *engine_, *processes_,
                                                               *normal_threads_, *phases_, *failsafe_, console_});
  run_->state.store(scheduler::NodeState::Running);
  console_.info("running {} modules of {}: basic period {}, macro period {}{}", config_.modules.size(),
                config_.file.filename().string(), deploy::format_duration(deploy::Nanos(setup_.basic_period_ns)),
                deploy::format_duration(deploy::Nanos(setup_.macro_period_ns)),
                obtained_.fifo != 0 ? fmt::format(", FIFO {} on core {}", scheduler::kTickPriority, core_) : "");
  return true;
}

// Empty if modules are on each.
std::vector<int> Node::cores_without_modules() const {
  std::vector<int> cores = rt::allowed_cores();
  std::erase_if(cores, [this](int core) {
    return core == core_ || std::any_of(config_.modules.begin(), config_.modules.end(),
                                        [core](const deploy::Module& module) { return module.core == core; });
  });
  return cores;
}

bool Node::start_mirror() {
  if (!mirror_settings_) {
    return true;
  }
  mirror_settings_->fifo_priority = obtained_.fifo != 0 ? scheduler::kMirrorPriority : 0;
  // Not where the modules are, if there is another core.
  const std::vector<int> cores = cores_without_modules();
  const auto spin = options_.spin.value_or(config_.spin.value_or(deploy::SpinSetting{}));
  mirror_settings_->spin = !cores.empty() && spin.mode != deploy::SpinSetting::Mode::Off && obtained_.fifo != 0;
  mirror_settings_->cores = cores.empty() ? rt::allowed_cores() : cores;
  auto started = mirror::Mirror::start(std::move(*mirror_settings_), options_.node, *store_, run_->tick);
  if (!started) {
    console_.error("cannot start the mirror to other boards: {}", describe(started.error()));
    return fail(kFailed);
  }
  mirror_ = std::move(started).value();
  return true;
}

scheduler::Hooks Node::hooks() {
  scheduler::Hooks hooks;
  hooks.context = this;
  hooks.entering = [](void*, std::uint32_t module) noexcept { runtime::set_current_module(module); };
  hooks.faulted = [](void* context, std::uint32_t module) noexcept {
    auto& self = *static_cast<Node*>(context);
    self.store_->release_locks_of_this_thread();
    runtime::release_calls_of_this_thread();
    self.failsafe_->apply(module);
  };
  hooks.stop_node = [](void* context, std::uint32_t module, const char* /*reason*/) noexcept {
    auto& self = *static_cast<Node*>(context);
    self.stop_order_.store(module + 1, std::memory_order_release);
    self.engine_->request_stop();
  };
  if (mirror_settings_) {
    hooks.worked = [](void* context) noexcept {
      auto& self = *static_cast<Node*>(context);
      if (self.mirror_) {
        self.mirror_->notify();
      }
    };
  }
  return hooks;
}

void Node::stop_because(const std::string& reason) {
  if (reason_.empty()) {
    reason_ = reason;
  }
  if (engine_ != nullptr) {
    engine_->request_stop();
  }
}

void Node::supervise() {
  while (!engine_->finished()) {
    const int number = signals_.wait(kLookNs);
    const std::int64_t now = rt::now_ns();
    store_->beat(now);
    if (number != 0) {
      exit_ = number == SIGINT ? kInterrupted : kOk;
      stop_because(fmt::format("signal {} ({})", number, ::strsignal(number)));
      break;
    }
    if (processes_->supervise(now)) {
      exit_ = kFailed;
      stop_because(processes_->reason());
      break;
    }
    orders_->look(now);
    forces_.look(*store_, console_);
    console_.report(now, false);
  }
  if (const std::uint32_t order = stop_order_.load(std::memory_order_acquire); order != 0) {
    exit_ = kFailed;
    stop_because(fmt::format(
        "module {}: {}", run_->modules()[order - 1].name,
        run_->modules()[order - 1].faults.load() > 0 ? "faulted (policy stop-node)" : "overrun (policy stop-node)"));
  }
}

void Node::shut_down() {
  if (run_ == nullptr) {
    return;
  }
  run_->state.store(scheduler::NodeState::Stopping);
  if (engine_ != nullptr) {
    engine_->request_stop();
    engine_->join();
  }
  if (normal_threads_ != nullptr) {
    normal_threads_->stop();
  }
  if (processes_ != nullptr) {
    processes_->end_all();
  }
  runtime::stop_function_servers();
  if (orders_ != nullptr) {
    orders_->end();
  }
  if (started_) {
    (void)phases_->call_all("stop", &ModuleDescriptor::stop);
  }
  external_.stop();
  mirror_.reset();  // what stop() wrote still travels; then the other boards see at once that this one is gone
  if (retainer_ != nullptr) {
    retainer_->stop(console_);
  }
  for (std::uint32_t i = 0; i < run_->module_count; ++i) {
    auto& state = run_->modules()[i].state;
    if (const ModuleState now = state.load(); now != ModuleState::Faulted && now != ModuleState::Exited) {
      state.store(ModuleState::Stopped);
    }
  }
}

int Node::finish() {
  if (run_ == nullptr) {
    return exit_;
  }
  console_.report(rt::now_ns(), true);
  if (run_->tick.load() == 0 && !reason_.empty() && exit_ == kFailed) {
    console_.error("stopped before the first tick: {}", reason_);
  }
  if (reason_.empty()) {
    reason_ = exit_ == kOk ? "end of the duration" : "could not start";
  }
  copy_text(run_->stop_reason, reason_);
  std::uint32_t faulted = 0;
  for (std::uint32_t i = 0; i < run_->module_count; ++i) {
    faulted += run_->modules()[i].state.load() == ModuleState::Faulted ? 1U : 0U;
  }
  if (run_->tick.load() > 0) {
    if (!options_.report.empty()) {
      std::string problem;
      if (!write_report(*run_, options_.report, problem)) {
        console_.error("{}", problem);
        exit_ = exit_ == kOk ? kFailed : exit_;
      }
    }
    if (!options_.quiet) {
      fmt::print("{}", summary_table(*run_));
    }
    console_.info("stopped: {}; {} ticks, {} lost", reason_, run_->tick.load(), run_->lost_ticks.load());
  }
  if (faulted > 0 && exit_ == kOk) {
    console_.error("{} module{} faulted during the run", faulted, faulted == 1 ? "" : "s");
    exit_ = kFailed;
  }
  run_->state.store(exit_ == kOk || exit_ == kInterrupted ? scheduler::NodeState::Stopped
                                                          : scheduler::NodeState::Failed);
  return exit_;
}

}  // namespace indurop::node
