// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/service_manager.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>

#include "core/base/descriptor.h"

namespace indurop::deploy {
namespace {

using namespace std::chrono_literals;

class ServiceManagerTest : public testing::Test {
 protected:
  ServiceManagerTest()
      : path_((std::filesystem::temp_directory_path() / ("notify-" + std::to_string(::getpid()))).string()),
        socket_(::socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::memcpy(address.sun_path, path_.data(), path_.size());
    EXPECT_EQ(::bind(socket_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    ::setenv("NOTIFY_SOCKET", path_.c_str(), 1);
  }
  ~ServiceManagerTest() override {
    for (const char* name : {"NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID"}) {
      ::unsetenv(name);
    }
    std::filesystem::remove(path_);
  }
  // The next message; empty: there is none.
  std::string heard() {
    std::array<char, 100> text{};
    const ssize_t got = ::recv(socket_.get(), text.data(), text.size(), 0);
    return got > 0 ? std::string(text.data(), static_cast<std::size_t>(got)) : std::string();
  }
  std::string path_;
  base::Descriptor socket_;
};

TEST_F(ServiceManagerTest, Says_when_it_is_ready_and_when_it_stops) {
  const ServiceManager sut;
  sut.ready();
  EXPECT_EQ(heard(), "READY=1");
  sut.stopping();
  EXPECT_EQ(heard(), "STOPPING=1");
}

TEST_F(ServiceManagerTest, Says_that_it_lives_at_least_twice_in_the_time_it_is_given) {
  ::setenv("WATCHDOG_USEC", "1000000", 1);
  ::setenv("WATCHDOG_PID", std::to_string(::getpid()).c_str(), 1);
  ServiceManager sut;
  int reports = 0;
  for (rt::MonoTime now = rt::mono_time(5'000'000'000); now < rt::mono_time(15'000'000'000); now += 20ms) {
    sut.alive(now);
    reports += heard() == "WATCHDOG=1" ? 1 : 0;
  }
  EXPECT_GE(reports, 20);
  EXPECT_LE(reports, 50);
}

TEST_F(ServiceManagerTest, Is_quiet_without_a_service_manager) {
  ServiceManager sut;
  sut.alive(rt::mono_time(1'000'000'000));
  ::setenv("WATCHDOG_USEC", "1000000", 1);
  ::setenv("WATCHDOG_PID", "1", 1);
  ServiceManager other;
  other.alive(rt::mono_time(1'000'000'000));
  EXPECT_EQ(heard(), "");
  ::unsetenv("NOTIFY_SOCKET");
  ServiceManager().ready();
  EXPECT_EQ(heard(), "");
}

}  // namespace
}  // namespace indurop::deploy
