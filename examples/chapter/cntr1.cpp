// Every fifth basic period (500 us): a slower calculation, set up by a property of its <module>.
#include <indurop/indurop.h>
#include <indurop/generated.h>

using namespace knu::Robot;

namespace {
int factor = 1;
}

void onStart() { factor = irp::property<int>("intialize value", 1); }

void onRun() {
  INDUROP_TYPEOF(joints)::value_type v = joints[0];
  INDUROP_TYPEOF(scaled)::value_type result;
  result.x = v.x * factor;
  result.y = v.y * factor;
  scaled = result;
}

INDUROP_MODULE(run = &::onRun, start = &::onStart, name = "cntr1", description = "scales the angles")
