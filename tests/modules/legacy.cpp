// SPDX-License-Identifier: Apache-2.0
// A program that knows nothing of InduRoP: SIGUSR1 wakes it, it writes how often into the file of its first argument.
// A second argument is how many milliseconds it takes until it is ready for that.
#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <string>

int main(int argc, char** argv) {
  if (argc > 2) {
    ::usleep(static_cast<useconds_t>(std::stoi(argv[2])) * 1000);
  }
  sigset_t set;
  ::sigemptyset(&set);
  ::sigaddset(&set, SIGUSR1);
  ::sigprocmask(SIG_BLOCK, &set, nullptr);
  const int file = argc > 1 ? ::open(argv[1], O_WRONLY | O_CREAT | O_TRUNC, 0600) : -1;
  for (int wakes = 1;; ++wakes) {
    int number = 0;
    ::sigwait(&set, &number);
    const std::string text = std::to_string(wakes);
    if (::pwrite(file, text.data(), text.size(), 0) < 0) {
      return 1;
    }
  }
}
