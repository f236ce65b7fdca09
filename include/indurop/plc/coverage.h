// SPDX-License-Identifier: Apache-2.0
// Execution counts of the statements of a PLC program built with --coverage. The counters are in a mapped file, so they
// survive however the program ends; counting is an addition in memory.

#pragma once

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace indurop::iec {

// One object per module, written by the thread that runs it. Counts in private memory unless INDUROP_PLC_COVERAGE names
// an existing folder: then in a new file there, MODULE.PID.N.plccov, whose bytes are kMagic, the number of counters and
// the size of the text as 64-bit words, the counters, and the text.
class Coverage {
 public:
  static constexpr std::uint64_t kMagic = 0x31564f43434c5049ULL;  // "IPLCCOV1"
  static constexpr std::size_t kHeadWords = 3;

  // `text`: the meaning of the counters; a static text.
  Coverage(const char* module, std::size_t counters, std::string_view text)
      : own_(kHeadWords + counters, 0), counts_(own_.data() + kHeadWords) {
    const char* folder = std::getenv("INDUROP_PLC_COVERAGE");
    if (folder != nullptr && *folder != '\0') {
      open(std::string(folder) + "/" + module + "." + std::to_string(::getpid()) + ".", counters, text);
    }
  }
  Coverage(const Coverage&) = delete;
  Coverage& operator=(const Coverage&) = delete;
  ~Coverage() {
    if (mapped_ != nullptr) {
      ::munmap(mapped_, size_);
    }
  }

  // Real-time safe.
  void hit(std::uint32_t counter) noexcept { ++counts_[counter]; }
  // The same; returns `yes`.
  bool outcome(std::uint32_t counter, bool yes) noexcept {
    ++counts_[counter + (yes ? 0U : 1U)];
    return yes;
  }

 private:
  void open(const std::string& begin, std::size_t counters, std::string_view text) {
    int file = -1;
    for (int number = 1; file < 0 && number <= kMaxFiles; ++number) {
      file = ::open((begin + std::to_string(number) + ".plccov").c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
      if (file < 0 && errno != EEXIST) {
        break;
      }
    }
    if (file < 0) {
      std::fprintf(stderr, "indurop: coverage: cannot make %s1.plccov: %s\n", begin.c_str(), std::strerror(errno));
      return;
    }
    const std::size_t words = kHeadWords + counters;
    size_ = words * sizeof(std::uint64_t) + text.size();
    // The space is reserved before anything is counted: a full disk must not end the program later.
    void* const to = ::posix_fallocate(file, 0, static_cast<off_t>(size_)) == 0
                         ? ::mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_POPULATE, file, 0)
                         : MAP_FAILED;
    ::close(file);
    if (to == MAP_FAILED) {
      std::fprintf(stderr, "indurop: coverage: no room for %s\n", begin.c_str());
      return;
    }
    mapped_ = to;
    auto* const at = static_cast<std::uint64_t*>(to);
    at[1] = counters;
    at[2] = text.size();
    std::memcpy(at + words, text.data(), text.size());
    at[0] = kMagic;
    counts_ = at + kHeadWords;
  }

  static constexpr int kMaxFiles = 10'000;
  std::vector<std::uint64_t> own_;
  std::uint64_t* counts_;
  void* mapped_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace indurop::iec
