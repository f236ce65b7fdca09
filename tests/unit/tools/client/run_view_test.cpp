// SPDX-License-Identifier: Apache-2.0
// The run block as a stranger's file: nothing in it is believed before it was checked.
#include "tools/client/node/run_view.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <atomic>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "deploy/agent/run_image.h"
#include "scheduler/run_block_setup.h"
#include "scheduler/statistics.h"
#include "store/runtime/message_ring.h"
#include "store/vars/node_lock.h"
#include "store/vars/run_file.h"

namespace indurop::tools {
namespace {

class RunViewTest : public ::testing::Test {
 protected:
  RunViewTest() : node_("run_view_test_" + std::to_string(getpid())) {
    scheduler::RunBlockSetup setup;
    setup.node_name = node_;
    setup.config_file = "module.xml";
    setup.basic_period_ns = 1'000'000;
    setup.macro_period_ns = 2'000'000;
    setup.slot_count = 2;
    setup.modules.resize(2);
    setup.modules[0].name = "first";
    setup.modules[1].name = "second";
    auto file = vars::RunFile::create(node_, scheduler::run_block_size(setup));
    EXPECT_TRUE(file.ok());
    block_ = static_cast<scheduler::RunBlock*>(file.value().data());
    file_.emplace(std::move(file).value());
    scheduler::init_run_block(*block_, setup);
  }
  ~RunViewTest() override { EXPECT_TRUE(vars::remove_shm_file(vars::run_file(node_)).ok()); }

  std::string node_;
  std::optional<vars::RunFile> file_;
  scheduler::RunBlock* block_ = nullptr;
};

TEST_F(RunViewTest, Shows_names_and_logs_oldest_first) {
  for (std::uint64_t tick = 0; tick < 5; ++tick) {
    scheduler::log_slot(*block_, {tick, 1, {100, 110, 150}});
  }
  const auto sut = RunView::open(node_);
  ASSERT_TRUE(sut.ok());
  EXPECT_EQ(sut.value().module_name(1), "second");
  EXPECT_EQ(sut.value().module_name(2), "?");
  EXPECT_EQ(sut.value().module_name(-1), "?");
  const auto log = sut.value().slot_log(3);
  ASSERT_EQ(log.size(), 3U);
  EXPECT_EQ(log.front().tick, 2U);
  EXPECT_EQ(log.back().tick, 4U);
  EXPECT_EQ(log.back().slot, 0U);
}

TEST_F(RunViewTest, Log_that_went_round_keeps_the_newest) {
  const std::uint64_t total = block_->slot_log_capacity + 100U;
  for (std::uint64_t tick = 0; tick < total; ++tick) {
    scheduler::log_slot(*block_, {tick, 0, {1, 2, 3}});
  }
  const auto sut = RunView::open(node_);
  ASSERT_TRUE(sut.ok());
  const auto log = sut.value().slot_log(UINT64_MAX);
  EXPECT_EQ(log.size(), block_->slot_log_capacity);
  EXPECT_EQ(log.front().tick, 100U);
}

TEST_F(RunViewTest, Entry_being_written_is_left_out) {
  scheduler::log_slot(*block_, {1, 0, {1, 2, 3}});
  block_->at<scheduler::SlotEntry>(block_->slot_log_offset)[0].sequence.store(0);
  const auto sut = RunView::open(node_);
  ASSERT_TRUE(sut.ok());
  EXPECT_TRUE(sut.value().slot_log(10).empty());
}

TEST_F(RunViewTest, Knows_whether_the_node_lives) {
  block_->node_pid.store(getpid());
  const auto sut = RunView::open(node_);
  ASSERT_TRUE(sut.ok());
  EXPECT_FALSE(sut.value().node_alive()) << "what a block says of itself does not count";
  pid_t holder = 0;
  const auto lock = vars::NodeLock::acquire(node_, holder);
  ASSERT_TRUE(lock.ok());
  EXPECT_TRUE(sut.value().node_alive());
  block_->node_pid.store(getppid());  // a run of another process
  EXPECT_FALSE(sut.value().node_alive());
  EXPECT_TRUE(vars::remove_shm_file(vars::lock_file(node_)).ok());
}

TEST_F(RunViewTest, Missing_and_foreign_files_are_named_errors) {
  EXPECT_EQ(RunView::open(node_ + "x").error().code, Errc::NotFound);
  block_->abi += 1;
  EXPECT_EQ(RunView::open(node_).error().code, Errc::VersionMismatch);
  block_->magic.store(77);
  EXPECT_EQ(RunView::open(node_).error().code, Errc::Corrupt);
}

TEST_F(RunViewTest, Offsets_and_counts_that_lead_outside_are_refused) {
  const auto refused = [this](auto& field, auto value) {
    const decltype(value) before = field;
    field = value;
    const bool ok = RunView::open(node_).ok();
    field = before;
    return !ok;
  };
  EXPECT_TRUE(refused(block_->module_count, 100'000'000U));
  EXPECT_TRUE(refused(block_->modules_offset, UINT64_MAX - 63));
  EXPECT_TRUE(refused(block_->modules_offset, std::uint64_t{8}));
  EXPECT_TRUE(refused(block_->slot_log_offset, block_->total_size));
  EXPECT_TRUE(refused(block_->slot_log_offset, block_->slot_log_offset + 1));
  EXPECT_TRUE(refused(block_->overrun_log_capacity, UINT32_MAX));
  EXPECT_TRUE(refused(block_->total_size, UINT64_MAX));
}

TEST_F(RunViewTest, What_a_damaged_block_says_stays_within_its_bounds) {
  std::mt19937_64 random(3);
  auto* bytes = reinterpret_cast<unsigned char*>(block_);
  const std::vector<unsigned char> good(bytes, bytes + sizeof(scheduler::RunBlock));
  for (int round = 0; round < 3000; ++round) {
    std::copy(good.begin(), good.end(), bytes);
    for (int i = 0; i < 3; ++i) {
      bytes[16 + random() % 1024 % (sizeof(scheduler::RunBlock) - 16)] = static_cast<unsigned char>(random());
    }
    const auto sut = RunView::open(node_);
    if (sut.ok()) {
      EXPECT_LE(sut.value().slot_log(100).size(), 100U);
      EXPECT_LE(sut.value().overrun_log(100).size(), 100U);
      EXPECT_LE(sut.value().messages(100).size(), 100U);
      for (std::uint32_t i = 0; i < sut.value().module_count(); ++i) {
        EXPECT_LE(sut.value().module_name(i).size(), sizeof(scheduler::ModuleRecord::name));
      }
    }
  }
}

TEST_F(RunViewTest, Shows_what_modules_printed_also_after_the_node_took_it) {
  const auto print = [&](std::uint32_t module, int ms) {
    return runtime::push_message(*block_, module, std::to_string(ms) + "\n", rt::mono_time(ms * 1'000'000LL));
  };
  runtime::MessageReader node(*block_);
  runtime::Message taken;
  int ms = 0;
  for (; ms < 200; ++ms) {
    ASSERT_TRUE(print(static_cast<std::uint32_t>(ms % 3), ms));
    EXPECT_TRUE(ms % 5 == 0 || node.next(taken, {}));
  }
  const auto sut = RunView::open(node_);
  ASSERT_TRUE(sut.ok());
  const auto five = sut->messages(5);
  ASSERT_EQ(five.size(), 5U);
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(five[static_cast<std::size_t>(i)].text, std::to_string(195 + i));
    EXPECT_EQ(five[static_cast<std::size_t>(i)].time_ns, (195 + i) * 1'000'000LL);
  }
  EXPECT_EQ(five[4].who, "second");
  EXPECT_EQ(five[0].who, "first");
  EXPECT_EQ(five[2].who, "node");
  EXPECT_EQ(sut->messages(1000).size(), 64 + 64 + 66U) << "of the two modules their newest";
}

// The one who prints is never waited for: what he overwrites meanwhile is left out, nothing else is ever seen.
TEST_F(RunViewTest, Messages_are_whole_while_they_are_printed) {
  std::atomic<bool> end = false;
  std::jthread printing([&] {
    runtime::MessageReader node(*block_);
    runtime::Message taken;
    for (std::int64_t i = 0; !end; ++i) {
      const std::string text(static_cast<std::size_t>(1 + i % 400), static_cast<char>('a' + i % 26));
      (void)runtime::push_message(*block_, 0, text, rt::mono_time(i));
      (void)node.next(taken, {});
    }
  });
  const auto sut = RunView::open(node_);
  ASSERT_TRUE(sut.ok());
  std::size_t seen = 0;
  for (int round = 0; round < 1000 || seen < 1000; ++round) {
    for (const MessageSample& one : sut->messages(1000)) {
      ASSERT_EQ(one.text, std::string(static_cast<std::size_t>(1 + one.time_ns % 400),
                                      static_cast<char>('a' + one.time_ns % 26)));
      ++seen;
    }
  }
  end = true;
}

TEST_F(RunViewTest, An_image_of_another_machine_shows_the_same) {
  for (std::uint64_t tick = 0; tick < 9; ++tick) {
    scheduler::log_slot(*block_, {tick, 1, {100, 110, 150}});
  }
  block_->at<scheduler::SlotEntry>(block_->slot_log_offset)[2].sequence.store(0);
  block_->modules()[1].runs.store(77);
  const std::string text = deploy::run_image(node_);
  const std::string image = text.substr(text.find('\n') + 1);
  EXPECT_LT(image.size(), file_->size()) << "the texts of modules are left out";
  const auto sut = RunView::from_image(image, true, 4711);
  ASSERT_TRUE(sut.ok());
  EXPECT_TRUE(sut->node_alive());
  EXPECT_FALSE(sut->here());
  EXPECT_EQ(sut->now_ns(), 4711);
  EXPECT_EQ(sut->module_name(1), "second");
  EXPECT_EQ(sut->module(1).runs.load(), 77U);
  EXPECT_TRUE(sut->messages(10).empty());
  const auto here = RunView::open(node_);
  ASSERT_TRUE(here.ok());
  const auto far_log = sut->slot_log(100);
  const auto log = here->slot_log(100);
  ASSERT_EQ(far_log.size(), 8U);
  ASSERT_EQ(log.size(), 8U);
  for (std::size_t i = 0; i < log.size(); ++i) {
    EXPECT_EQ(far_log[i].tick, log[i].tick);
    EXPECT_EQ(far_log[i].end_ns, log[i].end_ns);
  }
}

TEST_F(RunViewTest, Images_that_are_cut_off_or_damaged_are_refused_or_stay_within_their_bounds) {
  const std::string text = deploy::run_image(node_);
  const std::string image = text.substr(text.find('\n') + 1);
  for (std::size_t size = 0; size < image.size(); size += 997) {
    EXPECT_FALSE(RunView::from_image(image.substr(0, size), true, 0).ok()) << size;
  }
  std::mt19937_64 random(4);
  for (int round = 0; round < 200; ++round) {
    std::string damaged = image;
    for (int i = 0; i < 3; ++i) {
      damaged[random() % sizeof(scheduler::RunBlock)] = static_cast<char>(random());
    }
    const auto sut = RunView::from_image(damaged, true, 0);
    if (sut.ok()) {
      EXPECT_LE(sut->slot_log(100).size() + sut->overrun_log(100).size(), 200U);
      for (std::uint32_t i = 0; i < sut->module_count(); ++i) {
        EXPECT_LE(sut->module_name(i).size(), sizeof(scheduler::ModuleRecord::name));
      }
    }
  }
}

}  // namespace
}  // namespace indurop::tools
