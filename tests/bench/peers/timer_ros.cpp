// SPDX-License-Identifier: Apache-2.0
// ROS 1 (roscpp): how late a timer calls. Usage: timer_ros PERIOD_US SECONDS CORE; prints what peers.py reads. With
// FIFO 90 on the core, all threads of it. A rosmaster has to run.
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <sched.h>
#include <sys/mman.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <vector>

int main(int argc, char** argv) {
  if (argc < 4) {
    return 2;
  }
  const double period = std::atof(argv[1]) * 1e-6;
  const double seconds = std::atof(argv[2]);
  cpu_set_t set;
  CPU_ZERO(&set);
  CPU_SET(static_cast<std::size_t>(std::atoi(argv[3])), &set);
  sched_param parameters{};
  parameters.sched_priority = 90;
  if (sched_setaffinity(0, sizeof set, &set) != 0 || sched_setscheduler(0, SCHED_FIFO, &parameters) != 0 ||
      mlockall(MCL_CURRENT | MCL_FUTURE) != 0) {
    std::fprintf(stderr, "no real-time privileges\n");
    return 1;
  }
  ros::init(argc, argv, "peers_timer", ros::init_options::NoSigintHandler | ros::init_options::NoRosout);
  ros::NodeHandle node;
  std::vector<double> late;
  late.reserve(static_cast<std::size_t>(seconds / period * 2));
  const ros::SteadyTimer timer =
      node.createSteadyTimer(ros::WallDuration(period), [&](const ros::SteadyTimerEvent& event) {
        late.push_back((event.current_real - event.current_expected).toSec() * 1e9);
      });
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(seconds);
  while (ros::WallTime::now() < end) {
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(period));
  }
  const double expected = seconds / period;
  const double lost = std::max(0.0, 1 - static_cast<double>(late.size()) / expected);
  std::sort(late.begin(), late.end());
  const auto quantile = [&](double share) {
    return late.empty() ? 0.0 : late[static_cast<std::size_t>(share * static_cast<double>(late.size() - 1))];
  };
  std::printf("{\"p50\": %.0f, \"p99\": %.0f, \"lost\": %.6f}\n", quantile(0.5), quantile(0.99), lost);
  return 0;
}
