// SPDX-License-Identifier: Apache-2.0
// Delays against a frame that is followed through random trees of slaves, port by port, with cables of known length.

#include "control/io/ethercat/master/propagation.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace indurop::io::ethercat {
namespace {

struct Branch;
struct Node {
  bool has_clock = true;
  std::uint32_t clock_start = 0;  // its clock's time when the frame leaves the master
  std::vector<Branch> behind;     // in the order of ports 3, 1, 2
  std::uint32_t cable = 0;        // to it, ns, each way
};
struct Branch {
  int port = 0;
  Node node;
};

// Sends the frame through a slave and what is behind it; returns when it leaves through port 0.
class Walk {
 public:
  std::int64_t pass(const Node& node, std::int64_t now) {
    PortTimes times;
    times.has_clock = node.has_clock;
    times.is_open[0] = true;
    times.arrival[0] = node.clock_start + static_cast<std::uint32_t>(now);
    const std::size_t at = found_.size();
    found_.push_back(times);
    entered_.push_back(now);
    for (const auto& [port, next] : node.behind) {
      now = pass(next, now + next.cable) + next.cable;
      found_[at].is_open[static_cast<std::size_t>(port)] = true;
      found_[at].arrival[static_cast<std::size_t>(port)] = node.clock_start + static_cast<std::uint32_t>(now);
    }
    return now;
  }
  [[nodiscard]] const std::vector<PortTimes>& found() const { return found_; }
  [[nodiscard]] const std::vector<std::int64_t>& entered() const { return entered_; }

 private:
  std::vector<PortTimes> found_;
  std::vector<std::int64_t> entered_;
};

class RandomTree {
 public:
  explicit RandomTree(unsigned seed) : random_(seed) {}

  Node make(unsigned slaves, bool with_dumb) {
    Node root = slave(with_dumb);
    grow(root, slaves - 1, with_dumb);
    return root;
  }

 private:
  unsigned number(unsigned below) { return static_cast<unsigned>(random_() % below); }
  Node slave(bool with_dumb) {
    Node node;
    node.has_clock = !with_dumb || number(4) != 0;
    node.clock_start = static_cast<std::uint32_t>(random_());
    node.cable = number(1000);
    return node;
  }
  void grow(Node& node, unsigned slaves, bool with_dumb) {
    for (const int port : {3, 1, 2}) {
      if (slaves == 0 || (!node.has_clock && !node.behind.empty())) {
        return;
      }
      const unsigned there = node.has_clock && port != 2 ? number(slaves + 1) : slaves;
      if (there > 0) {
        Node next = slave(with_dumb);
        grow(next, there - 1, with_dumb);
        slaves -= there;
        node.behind.push_back({port, std::move(next)});
      }
    }
  }

  std::mt19937 random_;
};

std::vector<std::uint32_t> delays_of(const std::vector<PortTimes>& slaves, bool expected = true) {
  std::vector<std::uint32_t> delays(slaves.size());
  EXPECT_EQ(Propagation(slaves.size()).find(slaves, delays), expected);
  return delays;
}

TEST(Propagation, Is_that_of_a_frame_through_random_trees) {
  for (unsigned seed = 1; seed <= 500; ++seed) {
    SCOPED_TRACE(seed);
    Walk walk;
    walk.pass(RandomTree(seed).make(1 + seed % 40, false), 0);
    const auto delays = delays_of(walk.found());
    for (std::size_t i = 0; i < delays.size(); ++i) {
      EXPECT_EQ(delays[i], static_cast<std::uint32_t>(walk.entered()[i])) << i;
    }
  }
}

TEST(Propagation, Takes_slaves_without_a_clock_for_cable) {
  for (unsigned seed = 1; seed <= 500; ++seed) {
    SCOPED_TRACE(seed);
    Walk walk;
    walk.pass(RandomTree(seed).make(1 + seed % 40, true), 0);
    const auto delays = delays_of(walk.found());
    std::int64_t first = -1;
    for (std::size_t i = 0; i < delays.size(); ++i) {
      if (walk.found()[i].has_clock) {
        first = first < 0 ? walk.entered()[i] : first;
        EXPECT_EQ(delays[i], static_cast<std::uint32_t>(walk.entered()[i] - first)) << i;
      }
    }
  }
}

TEST(Propagation, Is_unknown_if_the_ports_make_no_tree) {
  PortTimes end;
  end.has_clock = true;
  end.is_open = {true, false, false, false};
  PortTimes middle = end;
  middle.is_open[1] = true;
  delays_of({middle}, false);    // a cable to no slave
  delays_of({end, end}, false);  // a slave at no cable
  PortTimes turned = end;
  turned.is_open = {false, true, false, false};
  delays_of({middle, turned}, false);  // entered through another port
  PortTimes fork = middle;
  fork.has_clock = false;
  fork.is_open[2] = true;
  delays_of({fork, end, end}, false);
  delays_of({}, false);
}

}  // namespace
}  // namespace indurop::io::ethercat
