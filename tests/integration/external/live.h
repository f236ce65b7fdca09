// SPDX-License-Identifier: Apache-2.0
// A running node of examples/external and programs that observe it: on one host, and as two machines.

#pragma once

#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "network/mirror/external/external_block.h"
#include "node_fixture.h"
#include "store/vars/shm_file.h"
#include "tests/support/dds_domain.h"

namespace indurop::test {

// This process and those it starts are on a network of their own, with nothing but loopback; without the right to that
// they stay where they are.
inline void leave_the_network() {
  if (::unshare(CLONE_NEWNET) == 0 && std::system("ip link set lo up") != 0) {
    ADD_FAILURE() << "loopback cannot be switched on";
  }
}

class Live : public NodeTest {
 protected:
  Live() { leave_the_network(); }
  // Tests that run at the same time do not hear each other, as root for sure.
  static std::string domain() { return std::to_string(dds_domain()); }

  // The example's module.xml, on loopback and with a domain of its own.
  std::string configuration(const std::string& types = EXAMPLE_FOLDER "/libstation_types.so",
                            const std::string& attributes = "",
                            const std::string& axis = EXAMPLE_FOLDER "/axis.so") const {
    return write("external.xml",
                 "<root><external interface=\"lo\"" + attributes + ">" + domain() + "</external><types>" + types +
                     "</types><variable name=\"station::target\" external=\"write\"/><module><filename>" + axis +
                     "</filename><moduletype>thread</moduletype><operationtype>periodic"
                     "</operationtype><period>1ms</period><priority>1</priority></module></root>");
  }
  Program& start_axis(const std::string& attributes = "") {
    Program& program = start_file(configuration(EXAMPLE_FOLDER "/libstation_types.so", attributes), {"--node", node()});
    EXPECT_TRUE(wait_until_running(program)) << program.err();
    EXPECT_TRUE(wait_until([&] { return block() != nullptr && block()->network.load() == mirror::Network::Up; }))
        << (block() == nullptr ? "no external plane" : block()->problem.get());
    EXPECT_TRUE(runs_reach("axis", 300)) << "what a late joiner gets first may be 100 ms old";
    return program;
  }
  const mirror::ExternalBlock* block() {
    if (!file_) {
      auto opened = vars::ShmFile::open(vars::external_file(node()), vars::Mode::ReadOnly);
      if (opened) {
        file_ = std::move(opened).value();
      }
    }
    return file_ ? reinterpret_cast<const mirror::ExternalBlock*>(file_->data()) : nullptr;
  }
  Program& tool(const std::vector<std::string>& words) {
    std::vector<std::string> command = words;
    command.front() = std::string(EXAMPLE_FOLDER) + "/" + command.front();
    const Environment alone{
        {"CYCLONEDDS_URI=<General><Interfaces><NetworkInterface name=\"lo\"/></Interfaces></General>",
         "FASTRTPS_DEFAULT_PROFILES_FILE=" EXAMPLE_SOURCES "/loopback_fastdds.xml",  // Fast DDS 2
         "FASTDDS_DEFAULT_PROFILES_FILE=" EXAMPLE_SOURCES "/loopback_fastdds.xml"},  // Fast DDS 3
        static_cast<uid_t>(-1),
        {}};
    programs_.push_back(std::make_unique<Program>(command, alone));
    return *programs_.back();
  }
  static std::size_t lines(Program& program) {
    const std::string text = program.out();
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
  }
  static void expect_plausible(const std::string& line) {
    std::istringstream in(line);
    std::string word;
    unsigned long long cycle = 0;
    double position = -1;
    double force[3] = {};
    std::string mode;
    int inside = -1;
    in >> word >> cycle >> word >> position >> word >> word >> force[0] >> force[1] >> force[2] >> word >> word >>
        mode >> word >> inside >> word;
    EXPECT_GT(cycle, 0U) << line;
    EXPECT_GE(position, 0) << line;
    EXPECT_LE(position, 100) << line;
    EXPECT_EQ(force[1], 9.5) << line;
    EXPECT_EQ(force[2], -9.5) << line;
    EXPECT_THAT(mode, ::testing::AnyOf("moving", "arrived")) << line;
    EXPECT_EQ(inside, 1) << line;
    EXPECT_CONTAINS(line, "program 'pick and place'");
  }
  static void expect_samples(Program& program, std::size_t count) {
    EXPECT_EQ(program.wait(), 0) << program.err();
    std::istringstream all(program.out());
    std::string line;
    std::size_t seen = 0;
    while (std::getline(all, line)) {
      expect_plausible(line);
      ++seen;
    }
    EXPECT_EQ(seen, count) << program.out() << program.err();
  }
  std::string get(const std::string& variable) const { return indurop({"get", variable, "--node", node()}).out; }

 private:
  std::optional<vars::ShmFile> file_;
};

// As in a real network: two machines, programs with their own defaults.
class Network : public Live {
 protected:
  Network() : lab_("xt" + std::to_string(::getpid() % 100'000)) {}
  ~Network() override {
    if (up_) {
      lab("down");
    }
  }
  bool up() {
    up_ = ::geteuid() == 0 && lab("up a b 2>/dev/null") == 0;
    return up_;
  }
  Program& on(const std::string& machine, const std::vector<std::string>& words) {
    std::vector<std::string> command{LAB_PROGRAM, "-l", lab_, "exec", machine};
    command.insert(command.end(), words.begin(), words.end());
    programs_.push_back(std::make_unique<Program>(command, environment()));
    return *programs_.back();
  }
  int lab(const std::string& words) const {
    return std::system((std::string(LAB_PROGRAM) + " -l " + lab_ + " " + words).c_str());
  }

 private:
  std::string lab_;
  bool up_ = false;
};

}  // namespace indurop::test
