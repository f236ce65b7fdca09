// Runs only when time is left: shows people what is going on.
#include <indurop/indurop.h>
#include <indurop/generated.h>

#include <chrono>
#include <thread>

using namespace knu::Robot;

int main() {
  while (!irp::stop_requested()) {
    irp::printf("tick %7u  joints[0] = {%6.2f, %6.2f}  total = {%7.2f, %7.2f}  limits reached %u, seen by vision %u\n",
                tick, joints[0].x, joints[0].y, total.x, total.y, limits_reached, seen_by_vision);
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
  }
  return 0;
}
