// SPDX-License-Identifier: Apache-2.0
#include "node/parts/black_box.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <vector>

#include "core/base/read_file.h"
#include "core/rt/fixed_text.h"
#include "history/explain/facts_json.h"
#include "history/explain/kernel_log.h"
#include "history/explain/run_facts.h"
#include "history/recorder/boxes.h"
#include "history/recorder/recorder.h"
#include "network/mirror/frames/mirror_block.h"
#include "node/parts/facts_part.h"
#include "node/parts/record_part.h"
#include "store/operate/journal.h"
#include "store/vars/box_request.h"
#include "store/vars/retain.h"
#include "store/vars/run_file.h"
#include "store/vars/shm_file.h"

namespace indurop::node {
namespace {

constexpr std::chrono::milliseconds kAfterwards{200};  // the runs shortly after a fault help to explain it
constexpr std::chrono::minutes kBetween{1};
constexpr std::chrono::milliseconds kRequestPoll{100};
constexpr std::uint64_t kManyOverruns = 10;  // within a second

// Deletes the oldest boxes, so that there is room for `next`.
void make_room(const std::filesystem::path& folder, const std::filesystem::path& next) {
  std::error_code ignored;
  std::vector<std::filesystem::path> boxes;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    if (entry.path().extension() == ".mcap") {
      boxes.push_back(entry.path());
    }
  }
  recorder::sort_oldest_first(boxes, next);
  for (std::size_t i = 0; i + kMaxBoxes <= boxes.size(); ++i) {
    std::filesystem::remove(boxes[i], ignored);
  }
}

// Writes the whole tape. Returns the file's path, or why it could not be written.
Result<std::filesystem::path, base::Problem> write_box(recorder::About about, const vars::Store& store,
                                                       const std::string& reason) {
  auto follower = tape::Follower::open(about.node, true);
  if (!follower) {
    return base::Problem{follower.error().where};
  }
  const auto folder = recorder::box_folder(about.node);
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    return base::Problem{fmt::format("cannot make {}: {}", folder.string(), error.message())};
  }
  const auto now = std::chrono::system_clock::now();
  const auto millis = std::chrono::duration_cast<std::chrono::milliseconds>(now.time_since_epoch()).count() % 1000;
  const auto file = folder / fmt::format("{:%Y%m%d-%H%M%S}-{:03}.mcap", fmt::gmtime(now), millis);
  make_room(folder, file);
  about.reason = reason;
  auto recorder = recorder::Recorder::create(file, about, store, std::move(follower).value(), {});
  if (!recorder) {
    return std::move(recorder).error();
  }
  if (auto taken = recorder->take(); !taken) {
    return std::move(taken).error();
  }
  if (auto closed = recorder->close(); !closed) {
    return std::move(closed).error();
  }
  return file;
}

void log_box(const Result<std::filesystem::path, base::Problem>& box, const std::string& reason,
             const Console& console) {
  if (box) {
    console.info("{}: the black box is in {}", reason, box->string());
  } else {
    console.warning("{}: the black box could not be written: {}", reason, box.error().text);
  }
}

std::string facts_of_crashed(const std::string& node, const scheduler::RunBlock& run, std::size_t size) {
  explain::Facts facts = explain::facts_of(run, size, false);
  explain::add_kernel(node, facts);
  const auto file = vars::ShmCopy::of(vars::mirror_file(node));
  if (const auto* boards = file ? mirror::mirror_block_in({file->data(), file->size()}) : nullptr; boards != nullptr) {
    explain::add_boards(*boards, facts);
  }
  facts.orders = operate::read_orders(node, run.started_wall_ns);
  facts.board = rt::text_of(run.board);
  facts.stop_reason = "its process died in the middle of its work";
  facts.now_ns = run.epoch_ns + static_cast<std::int64_t>(run.tick.load()) * run.basic_period_ns;
  facts.wall_minus_node_ns = rt::wall_ns() - rt::now_ns();
  return explain::facts_text(facts);
}

recorder::About about_crashed(const std::string& node, const scheduler::RunBlock& run, std::size_t size,
                              const vars::Store& store) {
  recorder::About about;
  about.node = node;
  const std::string config = rt::text_of(run.config_file);
  about.board = rt::text_of(run.board);
  about.config = about.board.empty() ? config : rt::text_of(run.plant_file);
  about.deployment = rt::text_of(run.deployment);
  about.basic_period_ns = run.basic_period_ns;
  about.real_minus_node_ns = rt::wall_ns() - rt::to_ns(store.now());
  if (auto text = base::read_file(config)) {
    about.files.emplace_back(std::filesystem::path(config).filename().string(), *std::move(text));
  }
  if (const auto facts = facts_of_crashed(node, run, size); !facts.empty()) {
    about.files.emplace_back(explain::kFactsFile, facts);
  }
  const std::uint64_t end = run.modules_offset + run.module_count * sizeof(scheduler::ModuleRecord);
  for (std::uint32_t i = 0; run.modules_offset < size && end <= size && i < run.module_count; ++i) {
    about.modules.push_back(rt::text_of(run.modules()[i].name));
  }
  return about;
}

}  // namespace

void keep_box_of_crash(const std::string& node, const Console& console) {
  const auto file = vars::RunFile::open(node, vars::Mode::ReadOnly, scheduler::kRunMagic, sizeof(scheduler::RunBlock));
  const auto store = vars::Store::attach(node, vars::Mode::ReadOnly);
  if (!file || !store) {
    return;
  }
  const auto& run = *static_cast<const scheduler::RunBlock*>(file->data());
  const auto state = run.state.load();
  const auto follower = tape::Follower::open(node, true);
  const bool crashed = state != scheduler::NodeState::Stopped && state != scheduler::NodeState::Failed;
  if (run.abi != scheduler::kRunAbi || !crashed || !follower || follower->header().node_pid != run.node_pid.load()) {
    return;
  }
  const std::string reason = fmt::format("the last run of node {} crashed", node);
  log_box(write_box(about_crashed(node, run, file->size(), *store), *store, reason), reason, console);
}

BlackBox::BlackBox(const Options& options, const Checked& checked, const Prepared& prepared, const BoardMirror& mirror,
                   Console& console)
    : options_(options), checked_(checked), prepared_(prepared), mirror_(mirror), console_(console) {
  vars::refuse_boxes_until(options.node, 0);  // left by an earlier run
}

BlackBox::~BlackBox() {
  if (writer_.joinable()) {
    writer_.join();
  }
}

std::uint64_t BlackBox::faults() const noexcept {
  const scheduler::RunBlock& run = prepared_.run();
  std::uint64_t sum = 0;
  for (std::uint32_t i = 0; i < run.module_count; ++i) {
    sum += run.modules()[i].faults.load(std::memory_order_acquire);
  }
  return sum;
}

void BlackBox::check(rt::MonoTime now) {
  if (!prepared_.tape) {
    return;
  }
  if (!due_ && faults() != kept_ && now >= next_) {
    due_ = now + kAfterwards;
  }
  if (std::string why = many_overruns(now); !due_ && !why.empty() && now >= next_overruns_) {
    request_ = std::move(why);
    due_ = now + kAfterwards;
    next_overruns_ = now + kBetween;
  }
  poll_requests(now);
  if (due_ && now >= *due_) {
    next_ = faults() != kept_ ? now + kBetween : next_;
    keep();
  }
}

void BlackBox::keep_at_end(std::string why) {
  request_ = std::move(why);
  due_ = rt::MonoClock::now();
}

void BlackBox::end() {
  if (prepared_.tape && (due_ || (faults() != kept_ && rt::MonoClock::now() >= next_))) {
    keep();
  }
  if (writer_.joinable()) {
    writer_.join();
  }
}

// A request may follow another after ten seconds; one that arrives while a box is about to be written is part of that
// box.
void BlackBox::poll_requests(rt::MonoTime now) {
  if (now - requests_polled_ < kRequestPoll) {
    return;
  }
  requests_polled_ = now;
  auto new_request = vars::take_box_request(options_.node);
  if (new_request && !due_ && now >= next_request_) {
    request_ = *std::move(new_request);
    due_ = now + kAfterwards;
    next_request_ = now + vars::kBetweenBoxes;
    vars::refuse_boxes_until(options_.node, rt::to_ns(next_request_));
  } else if (new_request && due_ && !request_.empty()) {
    request_ += "; " + *new_request;
  }
}

// Describes the overruns of the last second; empty: there were few.
std::string BlackBox::many_overruns(rt::MonoTime now) {
  if (now - overruns_checked_ < std::chrono::seconds(1)) {
    return {};
  }
  const scheduler::RunBlock& run = prepared_.run();
  const std::uint64_t all = run.overrun_log_next.load(std::memory_order_acquire);
  const std::uint64_t more = all - overruns_;
  overruns_ = all;
  overruns_checked_ = now;
  return more < kManyOverruns ? std::string()
                              : fmt::format("{} overruns within a second, up to tick {}", more, run.tick.load());
}

std::string BlackBox::newest_fault() const {
  const scheduler::RunBlock& run = prepared_.run();
  std::string reason;
  std::uint64_t latest = 0;
  for (std::uint32_t i = 0; i < run.module_count; ++i) {
    const scheduler::ModuleRecord& module = run.modules()[i];
    if (module.faults.load() > 0 && (reason.empty() || module.fault_tick.load() >= latest)) {
      latest = module.fault_tick.load();
      reason = fmt::format("fault of module {} at tick {}: {}", module.name, latest, module.last_fault);
    }
  }
  return reason;
}

void BlackBox::keep() {
  due_ = {};
  const bool faulted = faults() != kept_;
  kept_ = faults();
  const std::string fault = faulted || request_.empty() ? newest_fault() : "";
  const std::string reason = fault.empty() ? request_ : fault;
  request_.clear();
  if (writer_.joinable()) {
    writer_.join();
  }
  auto about = about_node(options_, checked_, prepared_);
  about.files.emplace_back(explain::kFactsFile, facts_text(options_, prepared_, mirror_.block(), {}));
  writer_ = std::thread([this, reason, about = std::move(about)] {
    log_box(write_box(about, *prepared_.store, reason), reason, console_);
  });
}

}  // namespace indurop::node
