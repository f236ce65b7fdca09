// SPDX-License-Identifier: Apache-2.0
// What makes a module's runs differ, by the symbols that a real compiler makes of real calls.

#include "config/check/determinism.h"

#include <gmock/gmock.h>

#include <chrono>
#include <fstream>
#include <random>
#include <thread>

#include "core/schema/elf.h"

namespace indurop::config {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// This program is the module that is checked: it really asks for these things.
void ask_the_system() {
  std::random_device device;
  std::ifstream file("/proc/self/comm");
  std::thread([] {}).join();
  (void)device();
  (void)std::chrono::steady_clock::now();
}

TEST(SourcesOfChance, Are_found_in_a_file_that_was_compiled) {
  ask_the_system();
  const auto self = schema::read_module_file("/proc/self/exe");
  ASSERT_TRUE(self.ok());
  const auto found = sources_of_chance(self->imports);
  EXPECT_THAT(found, Contains(HasSubstr("std::chrono::steady_clock")));
  EXPECT_THAT(found, Contains(HasSubstr("std::random_device")));
  EXPECT_THAT(found, Contains(HasSubstr("std::ifstream")));
  EXPECT_THAT(found, Contains(HasSubstr("std::thread")));
}

TEST(SourcesOfChance, Are_sorted_by_what_they_are) {
  EXPECT_THAT(sources_of_chance({"clock_gettime", "malloc", "recvfrom", "socket", "time"}),
              ElementsAre("real time (clock_gettime, time)", "the network (recvfrom, socket)"));
  EXPECT_THAT(sources_of_chance({"syscall"}), ElementsAre("calls of the kernel (syscall)"));
  EXPECT_THAT(sources_of_chance({"getpid"}), ElementsAre("numbers of processes (getpid)"));
  EXPECT_THAT(sources_of_chance({"open", "open64"}), ElementsAre("files or devices (open)")) << "once";
  EXPECT_THAT(sources_of_chance({"cos", "memcpy", "timer_of_mine", "_ZN3irp6now_nsEv", "srand"}), IsEmpty());
}

}  // namespace
}  // namespace indurop::config
