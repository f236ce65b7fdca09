// SPDX-License-Identifier: Apache-2.0
#include "node/run/prepared.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <utility>

#include "core/rt/clock.h"
#include "core/rt/file_lock.h"
#include "core/rt/thread.h"
#include "node/parts/black_box.h"
#include "node/parts/tape_part.h"
#include "node/run/setup.h"
#include "store/vars/custody.h"
#include "store/vars/node_lock.h"
#include "store/vars/process.h"
#include "store/vars/store.h"

namespace indurop::node {
namespace {

bool ended_well(const std::string& node) {
  const auto file = vars::RunFile::open(node, vars::Mode::ReadOnly, scheduler::kRunMagic, sizeof(scheduler::RunBlock));
  return file.ok() &&
         static_cast<const scheduler::RunBlock*>(file.value().data())->state.load() == scheduler::NodeState::Stopped;
}

// Removes the files of this user's nodes that ended in an orderly way, so that their values are on the disk or not
// needed. A node that crashed keeps its values for its restart.
void forget_old_nodes() {
  constexpr std::chrono::hours kKept{24};
  for (const std::string& node : vars::list_nodes()) {
    const auto beat = vars::last_beat(node);
    if (beat && rt::MonoClock::now() - *beat > kKept && vars::running_node(node) == 0 && ended_well(node)) {
      (void)vars::remove_node(node);  // busy: it has just started again; no rights: another user's
    }
  }
}

Ending no_memory(const char* what, const Error& error, const Console& console) {
  console.error("cannot make {}: {}{}", what, describe(error),
                error.sys_errno == EFBIG      ? "; the limit of file sizes is too small (`ulimit -f`)"
                : error.code == Errc::NoSpace ? "; free space in /dev/shm (`indurop clean`, `df /dev/shm`)"
                                              : "");
  return Ending{kFailed};
}

// Values of the last run are kept after a crash; an orderly new run begins with initial and retained ones, a simulation
// with initial ones. Returns what retains values, null in a simulation.
std::unique_ptr<Retainer> begin_values(const Options& options, vars::Store& store, bool previous_run_ended_well,
                                       Console& console) {
  if (options.simulation.on) {
    store.reset(false);
    return nullptr;
  }
  auto retainer = std::make_unique<Retainer>(store, options.node);
  if (store.origin() == vars::Origin::Fresh) {
    retainer->load(console, false);
    return retainer;
  }
  if (previous_run_ended_well) {
    store.reset(true);
  }
  if (store.origin() == vars::Origin::CarriedOver) {
    retainer->load(console, true);
  }
  return retainer;
}

void begin_run(scheduler::RunBlock& run, const scheduler::RunBlockSetup& setup, const scheduler::Obtained& obtained) {
  run.node_pid.store(::getpid());
  run.node_start_time = vars::process_start_time(::getpid());
  run.started_wall_ns = rt::wall_ns();
  run.obtained = obtained;
  scheduler::init_run_block(run, setup);
}

// Nodes that start at the same moment, as those of agents do when a plant is switched, choose their cores one after the
// other: each must see what the previous one has taken. The lock is that of the folder, which every user may open; a
// process that holds it too long delays the others by no more than this.
class CoreChoice {
 public:
  explicit CoreChoice(bool is_needed) noexcept
      : folder_(!is_needed ? -1 : ::open(vars::kShmDirectory, O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    constexpr std::chrono::seconds kTimeout{1};
    constexpr std::chrono::milliseconds kPause{2};
    const rt::MonoTime end = rt::MonoClock::now() + kTimeout;
    while (folder_ >= 0 && rt::lock_file(folder_, rt::FileLock::Exclusive).error().code == Errc::Busy &&
           rt::MonoClock::now() < end) {
      rt::sleep_until(rt::MonoClock::now() + kPause);
    }
  }
  CoreChoice(const CoreChoice&) = delete;
  CoreChoice& operator=(const CoreChoice&) = delete;
  ~CoreChoice() { end(); }
  void end() noexcept {
    if (folder_ >= 0) {
      ::close(std::exchange(folder_, -1));
    }
  }

 private:
  int folder_;
};

auto setup_of(const Options& options, const Checked& checked, const Rights& rights) {
  auto setup = make_run_setup(checked.config, checked.check, options.node, placement(options, rights));
  setup.deployment = options.deployment;
  setup.board = options.board;
  setup.plant_file = options.board.empty() ? "" : std::filesystem::absolute(options.config).string();
  return setup;
}

}  // namespace

ClaimedName::ClaimedName(std::string node, vars::NodeLock lock) : node_(std::move(node)), lock_(std::move(lock)) {
  remove_all_ = !vars::owner_of(node_).has_value();
}

ClaimedName::ClaimedName(ClaimedName&& other) noexcept
    : node_(std::move(other.node_)),
      lock_(std::move(other.lock_)),
      remove_all_(std::exchange(other.remove_all_, false)) {}

bool ClaimedName::hold() {
  if (lock_->named(node_)) {
    return true;
  }
  (void)lock_->make_again(node_);  // fails while another process checks it: then at the next check
  return false;
}

ClaimedName::~ClaimedName() {
  lock_.reset();
  if (remove_all_) {
    (void)vars::remove_node(node_);  // busy: another node has just taken over the name
  }
}

Result<ClaimedName, Ending> ClaimedName::claim(const std::string& node, const Console& console) {
  pid_t holder = 0;
  auto lock = vars::NodeLock::acquire(node, holder);
  if (lock) {
    return ClaimedName(node, std::move(lock).value());
  }
  if (lock.error().code == Errc::Busy) {
    console.error(
        "a node of this name is already running{}; stop it with `indurop stop --node {}` or choose another "
        "name with --node",
        holder > 0 ? fmt::format(" (pid {})", holder) : "", node);
  } else {
    const std::string owner = vars::other_owner(node);
    console.error("{}; choose another name with --node, or let {} remove /dev/shm/indurop.{}*", describe(lock.error()),
                  owner.empty() ? "their owner" : "user " + owner, node);
  }
  return Ending{kFailed};
}

Result<Prepared, Ending> prepare(const Options& options, const Checked& checked, Console& console,
                                 base::StopSignal& signals) {
  auto name = ClaimedName::claim(options.node, console);
  if (!name) {
    return std::move(name).error();
  }
  if (auto ending = interruption(signals)) {
    return *std::move(ending);
  }
  if (!options.simulation.on) {
    keep_box_of_crash(options.node, console);
  }
  const bool previous_run_ended_well = ended_well(options.node);
  forget_old_nodes();
  CoreChoice choice(!options.simulation.on);
  auto rights = options.simulation.on ? Result<Rights, Ending>(simulated_rights(options, checked.config))
                                      : obtain_rights(options, checked.config, console);
  if (!rights) {
    return std::move(rights).error();
  }
  auto pools = PoolsPart::create(options.node, checked.check.schema);  // before the store: who sees that, finds them
  if (!pools) {
    return no_memory("the pools", pools.error(), console);
  }
  auto made = vars::Store::create(options.node, checked.check.schema);
  if (!made) {
    return no_memory("the shared variables", made.error(), console);
  }
  auto store = std::make_unique<vars::Store>(std::move(made).value());
  auto setup = setup_of(options, checked, *rights);
  auto file = vars::RunFile::create(options.node, scheduler::run_block_size(setup));
  if (!file) {
    return no_memory("the run's shared memory", file.error(), console);
  }
  auto& run = *static_cast<scheduler::RunBlock*>(file->data());
  begin_run(run, setup, rights->obtained);
  choice.end();
  if (!checked.mirror) {
    (void)vars::remove_shm_file(vars::mirror_file(options.node));  // left by an earlier run as a board
  }
  auto failsafe = std::make_unique<FailSafe>(*store, checked.config);
  auto retainer = begin_values(options, *store, previous_run_ended_well, console);
  auto tape = make_tape(options, checked, setup.basic_period_ns, *store, console);
  if (!tape) {
    return no_memory("the tape", tape.error(), console);
  }
  auto batch = vars::Batch::create(options.node, *store);
  if (!batch) {
    return no_memory("changes from outside", batch.error(), console);
  }
  console.watch(run);
  if (const auto custody = vars::Custody::create(options.node); !custody) {
    return no_memory("its write lock", custody.error(), console);
  }
  return Prepared{std::move(name).value(), std::move(rights).value(), std::move(setup),    std::move(pools).value(),
                  std::move(store),        std::move(file).value(),   std::move(failsafe), std::move(retainer),
                  std::move(tape).value(), std::move(batch).value()};
}

}  // namespace indurop::node
