// SPDX-License-Identifier: Apache-2.0
#include "node/parts/record_part.h"

#include <pthread.h>

#include <utility>

#include "core/base/read_file.h"
#include "core/rt/clock.h"
#include "core/rt/thread.h"
#include "history/explain/facts_json.h"

namespace indurop::node {
namespace {

constexpr std::chrono::milliseconds kRecordPause{5};
constexpr std::chrono::seconds kFlush{1};

}  // namespace

recorder::About about_node(const Options& options, const Checked& checked, const Prepared& prepared) {
  recorder::About about;
  about.node = options.node;
  about.config = std::filesystem::absolute(checked.config.file).string();
  about.board = options.board;
  if (!options.board.empty()) {
    about.config = std::filesystem::absolute(options.config).string();  // of the plant
  }
  about.deployment = options.deployment;
  about.basic_period_ns = prepared.setup.basic_period_ns;
  // In a simulation the log times are virtual, too, so that two runs make the same file, and boards share one time.
  about.real_minus_node_ns = options.simulation.on ? 0 : rt::wall_ns() - rt::to_ns(prepared.store->now());
  for (const config::Module& module : checked.config.modules) {
    about.modules.push_back(module.name);
  }
  if (auto text = base::read_file(checked.config.file)) {
    about.files.emplace_back(checked.config.file.filename().string(), *std::move(text));
  }
  return about;
}

Result<std::unique_ptr<RecordPart>, Ending> RecordPart::begin(const Options& options, const Checked& checked,
                                                              const Prepared& prepared, Console& console) {
  if (options.record.empty()) {
    return std::unique_ptr<RecordPart>();
  }
  if (!prepared.tape) {
    console.error("--record needs the tape: leave out --tape 0");
    return Ending{kUsage};
  }
  auto follower = tape::Follower::open(options.node, true);
  if (!follower) {
    console.error("cannot read the tape: {}", describe(follower.error()));
    return Ending{kFailed};
  }
  auto recorder = recorder::Recorder::create(options.record, about_node(options, checked, prepared), *prepared.store,
                                             std::move(follower).value(), {});
  if (!recorder) {
    console.error("{}", recorder.error().text);
    return Ending{kFailed};
  }
  return std::unique_ptr<RecordPart>(new RecordPart(std::move(recorder).value(), console));
}

RecordPart::~RecordPart() {
  stop_.store(true);
  if (thread_.joinable()) {
    thread_.join();
  }
}

void RecordPart::start(const std::vector<int>& cores) {
  thread_ = std::thread([this, cores] {
    ::pthread_setname_np(::pthread_self(), "irp-record");
    (void)rt::pin_to_cores(cores);
    loop();
  });
}

void RecordPart::take() {
  if (!failure_.empty()) {
    return;
  }
  if (const auto taken = recorder_.take(); !taken) {
    failure_ = "the recording is not complete: " + taken.error().text;
  }
}

void RecordPart::take(rt::MonoTime now) {
  take();
  if (now - flushed_ >= kFlush) {
    (void)recorder_.flush();
    flushed_ = now;
  }
}

void RecordPart::loop() {
  rt::MonoTime flushed = rt::MonoClock::now();
  while (!stop_.load()) {
    take();
    if (const rt::MonoTime now = rt::MonoClock::now(); now - flushed > kFlush) {
      if (recorder_.flush()) {  // else tried again with the next chunk
        (void)recorder_.begin_sync();
      }
      flushed = now;
    }
    std::this_thread::sleep_for(kRecordPause);
  }
}

bool RecordPart::end(const std::string& facts) {
  stop_.store(true);
  if (thread_.joinable()) {
    thread_.join();
  }
  take();
  if (const auto attached = recorder_.attach(explain::kFactsFile, facts); !attached) {
    failure_ = attached.error().text;
  }
  if (const auto closed = recorder_.close(); !closed) {
    failure_ = closed.error().text;
  }
  if (!failure_.empty()) {
    console_.error("{}", failure_);
  }
  std::uint64_t lost = 0;
  for (const auto& [module, runs] : recorder_.counts().lost) {
    lost += runs;
  }
  for (const std::string& name : recorder_.too_large()) {
    console_.warning("{} is too large for the tape and not in the recording; a larger --tape may hold it", name);
  }
  if (lost > 0) {
    console_.warning(
        "{} runs are not in the recording: they were overwritten before they were read; use a larger --tape", lost);
  }
  console_.info("recorded {} runs, {} values of {} variables", recorder_.counts().runs, recorder_.counts().values,
                recorder_.variables());
  return failure_.empty() && lost == 0;
}

}  // namespace indurop::node
