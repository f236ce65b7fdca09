// SPDX-License-Identifier: Apache-2.0
// Bytes from slave to slave, judged in the memory of the slaves: what a frame read in the source is what the next frame
// writes to the target, whatever happens on the bus.
#include "control/io/ethercat/master/copies.h"

#include <gmock/gmock.h>

#include <deque>
#include <random>
#include <set>

#include "random_fault.h"
#include "simulated_plant.h"

namespace indurop::io::ethercat {
namespace {

using Block = std::vector<std::uint8_t>;

constexpr std::size_t kSlaveBytes = 24;  // of inputs, and of outputs, of each slave
constexpr unsigned kHeldTicks = 100;
constexpr Clock kHold = kHeldTicks * kTick;

Sii slave_sii() {
  Sii sii = drive_sii();
  sii.outputs = {{0x1600, 2, 0, "Outputs", {}}};
  sii.inputs = {{0x1A00, 3, 0, "Inputs", {}}};
  for (std::uint8_t i = 1; i <= kSlaveBytes; ++i) {
    sii.outputs[0].entries.push_back({0x7000, i, 8, 5, ""});
    sii.inputs[0].entries.push_back({0x6000, i, 8, 5, ""});
  }
  return sii;
}

std::vector<SlavePlan> plans_of_slaves(const std::vector<unsigned>& every) {
  std::vector<SlavePlan> plans;
  for (std::size_t i = 0; i < every.size(); ++i) {
    plans.push_back(plan_of(slave_sii(), static_cast<std::uint32_t>(0x10000 + 0x100 * i)));
    plans.back().every = every[i];
  }
  return plans;
}

// Slaves whose inputs are new random bytes in each tick, and a master between them.
class CopyPlant {
 public:
  // `every`: of each slave, how many cycles are between two exchanges; `fail_safe`: in each byte of the targets. Slaves
  // whose bit in the seed is set have no LRW.
  CopyPlant(const std::vector<unsigned>& every, std::vector<Copy> copies, unsigned seed = 1, std::uint8_t fail_safe = 0)
      : copies_(std::move(copies)), master_(bus_, without_lrw(plans_of_slaves(every), seed), kTick), random_(seed) {
    for (std::size_t i = 0; i < every.size(); ++i) {
      SlaveConfig config = config_of(master_.plan(i));
      config.esc.eeprom = sii_image(slave_sii());
      bus_.segment().add(config, [this](Bytes /*outputs*/, std::span<std::uint8_t> inputs) {
        std::generate(inputs.begin(), inputs.end(), [this] { return static_cast<std::uint8_t>(random_()); });
      });
      const auto outputs = master_.outputs(i);
      std::fill(outputs.begin(), outputs.end(), std::uint8_t{0xFF});
      master_.set_outputs_good(i, true);
    }
    const Block bytes(kSlaveBytes, fail_safe);
    for (const Copy& copy : copies_) {
      copy_bits(bytes, copy.to_bit, master_.outputs(copy.to), copy.to_bit, copy.bits);
    }
    sut_ = Copies(copies_, master_);
  }
  CopyPlant(std::size_t count, std::vector<Copy> copies, unsigned seed = 1)
      : CopyPlant(std::vector<unsigned>(count, 1), std::move(copies), seed) {}

  void tick() {
    now_ += kTick;
    bus_.advance(now_);
    master_.receive(now_);
    sut_.run(master_, now_);
    Block read;  // of all sources
    for (const Copy& copy : copies_) {
      const Block block = bits_of(copy.from, kDriveInputs, copy.from_bit, copy.bits);
      read.insert(read.end(), block.begin(), block.end());
    }
    read_.push_front(read);
    master_.send(now_);
    bus_.segment().compute();
    Event event;
    while (sut_.next_event(event)) {
      story_.push_back(std::to_string(now_ / kTick) + ": " + describe(event, "drive"));
    }
  }
  void run(unsigned ticks) {
    for (unsigned i = 0; i < ticks; ++i) {
      tick();
    }
  }
  void start() {
    for (unsigned i = 0; i < 4000 && !(io::ethercat::all_operate(master_) && all_fresh()); ++i) {
      tick();
    }
    ASSERT_TRUE(io::ethercat::all_operate(master_));
    run(3);
  }

  // What the target of a copy has in its memory.
  [[nodiscard]] Block written(std::size_t copy) {
    return bits_of(copies_[copy].to, kDriveOutputs, copies_[copy].to_bit, copies_[copy].bits);
  }
  // What the frame so many ticks ago read in the source.
  [[nodiscard]] Block read(std::size_t copy, std::size_t ago) const {
    std::size_t at = 0;
    for (std::size_t i = 0; i < copy; ++i) {
      at += copies_[i].bits;
    }
    const auto begin = read_[ago].begin() + static_cast<std::ptrdiff_t>(at);
    return {begin, begin + static_cast<std::ptrdiff_t>(copies_[copy].bits)};
  }
  // How many ticks ago that was what the target has.
  [[nodiscard]] std::size_t age(std::size_t copy) {
    const Block has = written(copy);
    std::size_t ago = 1;
    while (ago < ticks() && has != read(copy, ago)) {
      ++ago;
    }
    return ago;
  }
  [[nodiscard]] std::size_t ticks() const { return read_.size(); }
  [[nodiscard]] bool all_fresh() const {
    for (std::size_t i = 0; i < master_.size(); ++i) {
      if (!master_.is_fresh(i)) {
        return false;
      }
    }
    return true;
  }
  // What the target has besides, which no copy may change.
  [[nodiscard]] bool others_are_set(std::size_t slave) {
    Block bits = bits_of(slave, kDriveOutputs, 0, 8 * kSlaveBytes);
    for (const Copy& copy : copies_) {
      if (copy.to == slave) {
        std::fill_n(bits.begin() + static_cast<std::ptrdiff_t>(copy.to_bit), copy.bits, std::uint8_t{1});
      }
    }
    return std::all_of(bits.begin(), bits.end(), [](std::uint8_t bit) { return bit == 1; });
  }

  std::vector<std::string>& story() { return story_; }
  SimulatedBus& bus() { return bus_; }
  Slave& slave(std::size_t index) { return bus_.segment().slave(index); }
  Master& master() { return master_; }
  [[nodiscard]] Clock now() const { return now_; }

 private:
  // One byte for each bit.
  Block bits_of(std::size_t slave, std::uint16_t memory, std::size_t first, std::size_t count) {
    Block bits;
    const auto bytes = bus_.segment().slave(slave).esc().memory(memory, kSlaveBytes);
    for (std::size_t i = first; i < first + count; ++i) {
      bits.push_back(static_cast<std::uint8_t>((static_cast<unsigned>(bytes[i / 8]) >> (i % 8)) & 1U));
    }
    return bits;
  }

  std::vector<Copy> copies_;
  SimulatedBus bus_;
  Master master_;
  Copies sut_;
  std::vector<std::string> story_;
  std::mt19937 random_;
  std::deque<Block> read_;  // in each tick, the latest first
  Clock now_{0};
};

bool is_zero(const Block& block) {
  return std::all_of(block.begin(), block.end(), [](std::uint8_t bit) { return bit == 0; });
}

// To different bits of the targets, any bits of any length.
std::vector<Copy> random_copies(std::mt19937& random, std::size_t slaves) {
  std::vector<Copy> copies;
  for (std::size_t to = 0; to < slaves; ++to) {
    std::size_t room_at = random() % 16;
    while (true) {
      const std::size_t bits = 40 + random() % 80;
      if (room_at + bits > 8 * kSlaveBytes) {
        break;
      }
      const std::size_t from = (to + 1 + random() % (slaves - 1)) % slaves;
      copies.push_back({from, random() % (8 * kSlaveBytes - bits + 1), to, room_at, bits, kHold});
      room_at += bits + random() % 16;
    }
  }
  return copies;
}

TEST(Copies, What_one_frame_reads_the_next_one_writes) {
  std::mt19937 random(5);
  for (int round = 0; round < 20; ++round) {
    const std::size_t slaves = 2 + random() % 3;
    const auto copies = random_copies(random, slaves);
    CopyPlant sut(slaves, copies, static_cast<unsigned>(round));
    sut.start();
    for (int i = 0; i < 50; ++i) {
      sut.tick();
      for (std::size_t k = 0; k < copies.size(); ++k) {
        ASSERT_EQ(sut.written(k), sut.read(k, 1)) << "round " << round << ", copy " << k;
      }
      for (std::size_t k = 0; k < slaves; ++k) {
        ASSERT_TRUE(sut.others_are_set(k));
      }
    }
  }
}

// Faults by chance: a target never gets a mixture, nothing older than it may be or than it had before, and nothing of
// another slave.
TEST(Copies, Whatever_happens_a_target_has_what_its_source_had_or_zeros) {
  for (unsigned seed = 0; seed < 30 && !testing::Test::HasFailure(); ++seed) {
    std::mt19937 random(seed);
    const std::size_t slaves = 2 + random() % 3;
    const auto copies = random_copies(random, slaves);
    CopyPlant sut(slaves, copies, seed);
    sut.start();
    for (int i = 0; i < 5; ++i) {
      sut.bus().add_fault(random_fault(random, slaves, static_cast<FaultKind>(random() % kFaultKinds),
                                       sut.now() + std::chrono::milliseconds(1 + random() % 300)));
    }
    unsigned whole = 0;                                 // ticks in which all frames came back
    std::vector<bool> is_latest(copies.size(), false);  // the target had in the tick before what the frame before read
    std::vector<std::size_t> last(copies.size());       // tick in which the source had what the target has
    std::vector<unsigned> unexchanged(copies.size());   // ticks
    for (int i = 0; i < 1500; ++i) {
      sut.tick();
      whole = sut.all_fresh() ? whole + 1 : 0;
      for (std::size_t k = 0; k < copies.size(); ++k) {
        const std::string where =
            "seed " + std::to_string(seed) + ", tick " + std::to_string(i) + ", copy " + std::to_string(k);
        ASSERT_TRUE(whole < 4 || is_latest[k]) << where;
        const bool operates = sut.slave(copies[k].to).state() == AlState::Op;
        is_latest[k] = !operates;  // then it applies nothing
        if (!operates || is_zero(sut.written(k))) {
          continue;
        }
        const std::size_t ago = sut.age(k);
        // A target that is not exchanged has what it had.
        unexchanged[k] = sut.master().is_fresh(copies[k].to) ? 0 : unexchanged[k] + 1;
        ASSERT_LT(ago, kHeldTicks + 5 + unexchanged[k]) << where;
        ASSERT_GE(sut.ticks() - ago, last[k]) << where;
        last[k] = sut.ticks() - ago;
        is_latest[k] = ago == 1;
      }
    }
    EXPECT_GT(whole, 3U) << "seed " << seed << ": it recovers";
  }
}

class CopiesTest : public testing::Test {
 protected:
  void SetUp() override {
    sut_.start();
    ASSERT_EQ(sut_.written(0), sut_.read(0, 1));
  }
  void add(FaultKind kind, std::size_t slave, Time duration) {
    Fault fault;
    fault.kind = kind;
    fault.slave = slave;
    fault.at = sut_.now() + kTick;
    fault.duration = duration;
    sut_.bus().add_fault(fault);
  }
  // How many ticks the target has the same, other than zeros; the target operates in all of them.
  unsigned run_while_held() {
    const Block held = sut_.written(0);
    EXPECT_FALSE(is_zero(held));
    unsigned ticks = 0;
    while (sut_.written(0) == held && ticks < 2 * kHeldTicks) {
      sut_.tick();
      ++ticks;
      EXPECT_EQ(sut_.slave(1).state(), AlState::Op);
    }
    return ticks;
  }

  // The source is behind its target, which so stays while the source is away.
  CopyPlant sut_{3, {{2, 5, 1, 3, 88, kHold}}};
};

TEST_F(CopiesTest, A_lost_frame_gives_the_target_no_new_bytes) {
  add(FaultKind::FramesLost, 0, kTick);
  sut_.tick();  // is lost
  EXPECT_EQ(sut_.age(0), 2U) << "the target has what it had";
  sut_.tick();
  EXPECT_EQ(sut_.age(0), 2U) << "what the lost frame had, and what the source had then never came";
  sut_.tick();
  EXPECT_EQ(sut_.age(0), 1U);
}

TEST_F(CopiesTest, A_source_that_is_lost_is_zero_after_a_tenth_of_a_second) {
  add(FaultKind::PowerOff, 2, std::chrono::milliseconds(400));
  sut_.run(2);
  EXPECT_NEAR(run_while_held(), kHeldTicks, 3);
  EXPECT_TRUE(is_zero(sut_.written(0)));
  EXPECT_TRUE(sut_.others_are_set(1));
  sut_.start();
  EXPECT_EQ(sut_.written(0), sut_.read(0, 1)) << "it is back";
  EXPECT_THAT(sut_.story(),
              testing::ElementsAre(testing::HasSubstr("slave 1 (drive): gets what is copied from slave 2"),
                                   testing::HasSubstr("slave 1 (drive): slave 2 has no valid bytes to copy to it"),
                                   testing::HasSubstr("gets what is copied from slave 2")));
}

TEST_F(CopiesTest, A_source_whose_counter_is_wrong_is_zero_although_it_says_it_operates) {
  add(FaultKind::WrongCounter, 2, std::chrono::milliseconds(300));
  sut_.run(2);
  EXPECT_NEAR(run_while_held(), kHeldTicks, 3);
  EXPECT_TRUE(is_zero(sut_.written(0)));
  EXPECT_EQ(sut_.slave(2).state(), AlState::Op);
}

TEST_F(CopiesTest, Another_device_in_its_place_is_no_source) {
  add(FaultKind::OtherIdentity, 2, std::chrono::milliseconds(900));
  sut_.run(300);
  for (int i = 0; i < 500; ++i) {
    sut_.tick();
    ASSERT_TRUE(is_zero(sut_.written(0))) << "it has inputs, too";
  }
  sut_.run(300);
  sut_.start();
  EXPECT_EQ(sut_.written(0), sut_.read(0, 1));
}

TEST_F(CopiesTest, A_target_that_comes_back_gets_what_is_new) {
  add(FaultKind::PowerOff, 1, std::chrono::milliseconds(50));
  sut_.run(60);
  sut_.start();
  EXPECT_EQ(sut_.written(0), sut_.read(0, 1));
}

TEST(Copies, Before_the_first_bytes_of_the_source_the_target_has_zeros) {
  CopyPlant sut(2, {{1, 0, 0, 8, 64, kHold}});
  sut.slave(1).refuse_state(AlState::Op, 0x8000, 3);
  unsigned operated = 0;
  for (int i = 0; i < 2000 && !sut.master().slave(1).operates(); ++i) {
    sut.tick();
    if (sut.slave(0).state() == AlState::Op) {
      ASSERT_TRUE(is_zero(sut.written(0)));
      ++operated;
    }
  }
  EXPECT_GT(operated, 100U);
}

TEST(Copies, Without_time_to_hold_a_target_has_its_fail_safe_values_as_soon_as_a_frame_is_lost) {
  CopyPlant sut({1, 1}, {{0, 0, 1, 8, 64, Clock{0}}}, 1, 0xA5);
  sut.start();
  ASSERT_EQ(sut.written(0), sut.read(0, 1));
  sut.bus().add_fault({FaultKind::FramesLost, sut.now() + kTick, kTick});
  sut.run(2);
  const Block fail_safe = sut.written(0);
  for (std::size_t i = 0; i < fail_safe.size(); ++i) {
    EXPECT_EQ(fail_safe[i], 0xA5U >> (i % 8) & 1U) << i;
  }
  sut.tick();
  EXPECT_EQ(sut.written(0), sut.read(0, 1));
}

// Sources and targets that are exchanged once in some cycles: each exchange of the target writes what the latest one of
// the source read.
TEST(Copies, Slaves_of_other_cycles_get_what_the_latest_exchange_read) {
  for (const auto& every : std::vector<std::vector<unsigned>>{{1, 4}, {4, 1}, {2, 4}, {4, 2}, {4, 4}}) {
    CopyPlant sut(every, {{0, 0, 1, 8, 64, kHold}});
    sut.start();
    sut.run(20);
    const unsigned slow = std::max(every[0], every[1]);
    std::set<std::size_t> ages;
    for (int i = 0; i < 40; ++i) {
      sut.tick();
      ages.insert(sut.age(0));
    }
    EXPECT_LE(*ages.rbegin(), every[0] + every[1]) << every[0] << ", " << every[1];
    EXPECT_EQ(ages.size(), slow) << "the same ages again and again";
  }
}

}  // namespace
}  // namespace indurop::io::ethercat
