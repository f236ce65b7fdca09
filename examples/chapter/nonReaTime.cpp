// Runs only when time is left: shows people what is going on.
#include <indurop/indurop.h>
#include <indurop/generated.h>

#include <chrono>
#include <thread>

using namespace knu::Robot;

int main() {
  while (!irp::stop_requested()) {
    INDUROP_TYPEOF(joints)::value_type v = joints[2];
    irp::printf("tick %8u  joints[2] = {%7.2f, %7.2f, %7.2f}  limits reached %u, seen by vision %u\n", tick, v.x, v.y,
                v.z, limits_reached, seen_by_vision);
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
  }
  return 0;
}
