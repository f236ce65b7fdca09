// SPDX-License-Identifier: Apache-2.0
// Files that are cut while they are mapped.
#include "core/rt/lost_pages.h"

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>
#include <csignal>

#include <atomic>
#include <cstring>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/rt/guard.h"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#include <sanitizer/common_interface_defs.h>
#endif

namespace indurop::rt {
namespace {

constexpr std::size_t kPage = 4096;
#if defined(__SANITIZE_ADDRESS__)
constexpr int kSanitizerExit = 1;
#elif defined(__SANITIZE_THREAD__)
constexpr int kSanitizerExit = 66;
#endif

// A file of pages full of 7, mapped.
class Mapped {
 public:
  explicit Mapped(std::size_t pages, bool writable = true)
      : bytes_(pages * kPage), file_(::memfd_create("lost_pages_test", MFD_CLOEXEC)) {
    EXPECT_EQ(::ftruncate(file_, static_cast<off_t>(bytes_)), 0);
    const std::vector<unsigned char> content(bytes_, 7);
    EXPECT_EQ(::pwrite(file_, content.data(), bytes_, 0), static_cast<ssize_t>(bytes_));
    const int access = writable ? PROT_READ | PROT_WRITE : PROT_READ;
    memory = static_cast<volatile unsigned char*>(::mmap(nullptr, bytes_, access, MAP_SHARED, file_, 0));
  }
  Mapped(const Mapped&) = delete;
  Mapped& operator=(const Mapped&) = delete;
  ~Mapped() {
    ::munmap(const_cast<unsigned char*>(memory), bytes_);
    ::close(file_);
  }
  void cut(std::size_t pages) const { ASSERT_EQ(::ftruncate(file_, static_cast<off_t>(pages * kPage)), 0); }
  [[nodiscard]] GuardedMapping guard(bool writable = true) const {
    return {const_cast<unsigned char*>(memory), bytes_, writable, "a file"};
  }
  volatile unsigned char* memory = nullptr;

 private:
  std::size_t bytes_;
  int file_;
};

TEST(LostPages, Are_zeros_and_the_rest_stays) {
  const Mapped file(4);
  const GuardedMapping sut = file.guard();
  EXPECT_FALSE(sut.lost());
  file.cut(2);
  EXPECT_FALSE(sut.lost()) << "they were not needed yet";
  EXPECT_EQ(file.memory[2 * kPage + 5], 0);
  EXPECT_TRUE(sut.lost());
  EXPECT_EQ(file.memory[4 * kPage - 1], 0);
  EXPECT_EQ(file.memory[2 * kPage - 1], 7);
  file.memory[3 * kPage] = 3;
  EXPECT_EQ(file.memory[3 * kPage], 3);
}

TEST(LostPages, Of_a_file_that_is_only_read_are_zeros_too) {
  const Mapped file(1, false);
  const GuardedMapping sut = file.guard(false);
  file.cut(0);
  EXPECT_EQ(file.memory[100], 0);
  EXPECT_TRUE(sut.lost());
}

TEST(LostPages, Are_reported_with_their_name_at_once) {
  const Mapped file(2);
  const GuardedMapping sut = file.guard();
  std::string reported;
  on_lost_page([](void* context, const char* name) { *static_cast<std::string*>(context) = name; }, &reported);
  file.cut(1);
  EXPECT_EQ(file.memory[0], 7);
  EXPECT_EQ(reported, "");
  EXPECT_EQ(file.memory[kPage], 0);
  EXPECT_EQ(reported, "a file");
  on_lost_page(nullptr, nullptr);
}

std::atomic<int> g_asked{0};

bool ask_library(int number, void* /*address*/) noexcept {
  g_asked = number;
  return false;
}

// A thread that a library guards must not continue with zeros, whichever copy of this code has mapped the file.
TEST(LostPages, Are_shown_to_the_guards_of_a_library_too) {
  const Mapped file(1);
  const GuardedMapping sut = file.guard();
  catch_faults_also_by(ask_library);
  file.cut(0);
  EXPECT_EQ(file.memory[0], 0);
  catch_faults_also_by(nullptr);
  EXPECT_EQ(g_asked, SIGBUS);
}

TEST(LostPages, Many_mappings_come_and_go_while_others_are_cut) {
  std::atomic<bool> end{false};
  std::thread other([&end] {
    while (!end.load()) {
      const Mapped file(1);
      const GuardedMapping sut = file.guard();
      EXPECT_FALSE(sut.lost());
    }
  });
  for (int i = 0; i < 300; ++i) {
    const Mapped file(3);
    GuardedMapping first = file.guard();
    const GuardedMapping sut = std::move(first);
    file.cut(static_cast<std::size_t>(i) % 3);
    EXPECT_EQ(file.memory[3 * kPage - 1], 0);
    EXPECT_TRUE(sut.lost());
  }
  end.store(true);
  other.join();
}

// As a program of a user may have one.
void leave_with_42(int /*number*/) {
  ::_exit(42);
}

TEST(LostPagesDeathTest, An_earlier_plain_handler_is_called_for_foreign_faults) {
  EXPECT_EXIT(
      {
        ::signal(SIGFPE, leave_with_42);
        install_guard_handlers();
        install_guard_handlers();
        ::raise(SIGFPE);
      },
      ::testing::ExitedWithCode(42), "");
}

TEST(LostPagesDeathTest, Guarded_mappings_survive_whichever_handler_came_first) {
  const auto lives = [](bool guard_first) {
    if (guard_first) {
      install_guard_handlers();
    }
    const Mapped file(1);
    const GuardedMapping sut = file.guard();
    if (!guard_first) {
      install_guard_handlers();
    }
    file.cut(0);
    ::_exit(file.memory[0] == 0 && sut.lost() ? 7 : 1);
  };
  EXPECT_EXIT(lives(true), ::testing::ExitedWithCode(7), "");
  EXPECT_EXIT(lives(false), ::testing::ExitedWithCode(7), "");
}

TEST(LostPagesDeathTest, A_file_without_a_guard_ends_the_process_as_before) {
  const Mapped guarded(1);
  const GuardedMapping sut = guarded.guard();
  const Mapped file(1);
  file.cut(0);
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  // Its handler was there before; what it reports is expected, so it is no finding.
  const ::testing::ExitedWithCode ended(kSanitizerExit);
  const auto expect_report = [] { __sanitizer_set_report_path("stderr"); };
#else
  const ::testing::KilledBySignal ended(SIGBUS);
  const auto expect_report = [] {};
#endif
  EXPECT_EXIT(expect_report(); static_cast<void>(file.memory[0]), ended, "");
}

}  // namespace
}  // namespace indurop::rt
