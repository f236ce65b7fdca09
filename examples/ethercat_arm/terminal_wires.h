// SPDX-License-Identifier: Apache-2.0
// The wires of sensors to the simulated input terminal: lines of the script that indurop-ecsim reads. A terminal is
// wired to one world: that of another run in this folder, such as a simulated one, waits until the first has ended.
#pragma once

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdio>
#include <string>

class TerminalWires {
 public:
  // `fifo`: where indurop-ecsim reads its script.
  explicit TerminalWires(std::string fifo) : fifo_(std::move(fifo)) {}
  TerminalWires(const TerminalWires&) = delete;
  TerminalWires& operator=(const TerminalWires&) = delete;
  ~TerminalWires() { disconnect(); }

  void set(std::size_t channel, bool value) { now_[channel] = value ? 1 : 0; }
  // Sends what has changed. All is sent again after the simulation was away.
  void send() {
    if (pipe_ < 0) {
      connect();
    }
    std::string lines;
    for (std::size_t i = 0; pipe_ >= 0 && i < now_.size(); ++i) {
      if (now_[i] != sent_[i]) {
        std::array<char, 64> line{};
        std::snprintf(line.data(), line.size(), "0s value slave=0 at=%zx:1 to=%d\n", 0x6000 + 0x10 * i, now_[i]);
        lines += line.data();
        sent_[i] = now_[i];
      }
    }
    if (!lines.empty() && write(pipe_, lines.data(), lines.size()) != static_cast<ssize_t>(lines.size())) {
      disconnect();
    }
  }

 private:
  static constexpr int kUnknown = -1;

  void connect() {
    pipe_ = open(fifo_.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC);
    sent_.fill(kUnknown);
    if (pipe_ >= 0 && flock(pipe_, LOCK_EX | LOCK_NB) != 0) {
      disconnect();
    }
  }
  void disconnect() {
    if (pipe_ >= 0) {
      close(pipe_);
    }
    pipe_ = -1;
  }

  std::string fifo_;
  int pipe_ = -1;
  std::array<int, 16> now_{};
  std::array<int, 16> sent_{};
};
