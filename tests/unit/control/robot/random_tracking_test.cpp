// SPDX-License-Identifier: Apache-2.0
// Random products on random belts: where the tip is by orocos-kdl, seen from where the product really is, is the path
// that was asked for, and no set point breaks a limit whatever happens. INDUROP_ROBOT_BELTS says how many runs,
// INDUROP_ROBOT_SEED from which one on.

#include <map>

#include "random_belts.h"

namespace indurop::robot {
namespace {

// The path on the product is judged from the first motion on that has ended well.
class RandomLines : public RandomBelts {
 protected:
  int good = 0;
  int bad = 0;
  Given any_motion(KDL::Vector& to) {
    to = {between(-40, 40), between(-40, 40), between(60, 200)};
    return product(to[0], to[1], to[2], between(50, 400));
  }
};

void tell(int good, int bad, double worst, const std::map<std::string, int>& why) {
  fmt::print("{} motions on products, {} that could not be, worst {:.2f} of what is allowed\n", good, bad, worst);
  for (const auto& [text, times] : why) {
    fmt::print("  {} x {}\n", times, text);
  }
}

TEST_F(RandomLines, The_path_is_on_the_product_and_no_limit_is_broken) {
  const int runs = number_of("INDUROP_ROBOT_BELTS", 40);
  const int seed = number_of("INDUROP_ROBOT_SEED", 1);
  std::map<std::string, int> why;
  double worst = 0;
  for (int run_number = seed; run_number < seed + runs && !failed; ++run_number) {
    SCOPED_TRACE(run_number);
    random.seed(static_cast<unsigned>(run_number));
    const bool turns = one_of(3) == 0;
    const bool disturbed = one_of(2) == 0;
    choose_belt(turns);
    choose_origin(turns);
    ASSERT_TRUE(run(machine(500, 0, 400)));
    begin_tracking(from, on_it, turns);
    KDL::Vector here;
    KDL::Vector to;
    bool known = false;
    for (int k = 0; k < 5 && cell.out.state != GroupState::ErrorStop; ++k) {
      const Given motion = any_motion(to);
      int periods = 0;
      ASSERT_TRUE(until([&] {
        if (disturbed) {
          disturb(periods++);
        }
        // While the tool returns to the belt it is off the path.
        if (known && !disturbed && state(motion) == CommandState::Active && cell.out.error == ErrorCode::Ok) {
          const KDL::Vector along = to - here;
          const double part = KDL::dot(tip() - here, along) / KDL::dot(along, along);
          const double off = (tip() - here - along * part).Norm();
          worst = std::max(worst, off / near);
          EXPECT_LT(off, near) << time;
        }
        return ended(motion);
      }));
      cell.in.hold = false;
      cell.in.speed_override = 100;
      known = state(motion) == CommandState::Done;
      int& count = known ? good : bad;
      ++count;
      if (known) {
        EXPECT_LT((tip() - to).Norm(), near) << time;
        here = to;
      } else {
        ++why[to_string(error(motion))];
      }
    }
    if (cell.out.state == GroupState::Moving) {
      give(Service::Halt);
    }
    ASSERT_TRUE(
        until([&] { return cell.out.state == GroupState::Standby || cell.out.state == GroupState::ErrorStop; }));
    if (cell.out.state == GroupState::ErrorStop) {
      ++why[(disturbed ? "with holds and overrides: " : "undisturbed: ") + message()];
      ASSERT_TRUE(run(give(Service::GroupReset)));
    }
    ASSERT_TRUE(run(give(Service::DirectAbsolute, {0, 10, -20, 0, 60, 0})));
  }
  tell(good, bad, worst, why);
  EXPECT_GT(good, 5 * bad);
}

}  // namespace
}  // namespace indurop::robot
