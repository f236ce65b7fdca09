// SPDX-License-Identifier: Apache-2.0
// Random products on random belts: where the tip is by orocos-kdl, seen from where the product really is, is the path
// that was asked for, and no set point breaks a limit whatever happens. INDUROP_ROBOT_BELTS says how many runs,
// INDUROP_ROBOT_SEED from which one on.

#include <cstdlib>
#include <map>
#include <random>

#include "belt_cell.h"

namespace indurop::robot {
namespace {

// Random belts, tables, products and motions, with holds, overrides, stops and failures. The path on the product is
// judged from the first motion on that has ended well.
class RandomBelts : public Belts {
 protected:
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  int one_of(int most) { return std::uniform_int_distribution<int>(0, most - 1)(random); }

  // As steady as belts are, or swinging slowly.
  void choose_belt(bool turns) {
    const double most = turns ? 12 : 120;
    const double speed = between(-most, most);
    const double swings = one_of(2) == 0 ? 0 : between(0, most / 4);
    const double often = between(0.3, 2);
    belt = [=](double t) { return 1000 + speed * t + swings / often * std::sin(often * t); };
    resolution = one_of(2) == 0 ? 1e-4 : 0.01;
    // What filters of 30 ms make of a swing and of steps, once where the product is now, once where it was at first.
    const double size = turns ? 600 * kPi / 180 : 1;  // mm
    near = 0.01 + size * 2 * (6 * resolution + 20 * swings * often * often / 27000);
  }
  void choose_origin(bool turns) {
    const double way = between(-180, 180);
    from = turns ? Eight{between(450, 550), between(-60, 60), between(150, 250), 0, 0, way}
                 : Eight{between(450, 520), between(-80, 80), between(150, 250), 0, between(-5, 5), way};
    const double on_table = turns ? between(-90, 90) : between(-20, 20);
    on_it = {on_table, between(-20, 20), between(0, 20), 0, 0, -way + between(-30, 30)};
  }
  Given any_motion(KDL::Vector& to) {
    to = {between(-40, 40), between(-40, 40), between(60, 200)};
    return product(to[0], to[1], to[2], between(50, 400));
  }
  void disturb(int period) {
    if (period > 150) {
      cell.in.hold = false;
      cell.in.speed_override = 100;
      return;
    }
    if (one_of(60) == 0) {
      cell.in.hold = !cell.in.hold;
    }
    if (one_of(60) == 0) {
      cell.in.speed_override = between(0, 100);
    }
  }

  std::mt19937 random;
  Eight from{}, on_it{};
  double near = 0;
};

int number_of(const char* name, int otherwise) {
  const char* text = std::getenv(name);
  return text != nullptr ? std::atoi(text) : otherwise;
}

void tell(int good, int bad, double worst, const std::map<std::string, int>& why) {
  fmt::print("{} motions on products, {} that could not be, worst {:.2f} of what is allowed\n", good, bad, worst);
  for (const auto& [text, times] : why) {
    fmt::print("  {} x {}\n", times, text);
  }
}

TEST_F(RandomBelts, The_path_is_on_the_product_and_no_limit_is_broken) {
  const int runs = number_of("INDUROP_ROBOT_BELTS", 40);
  const int seed = number_of("INDUROP_ROBOT_SEED", 1);
  int good = 0, bad = 0;
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
    KDL::Vector here, to;
    bool known = false;
    for (int k = 0; k < 5 && cell.out.state != GroupState::ErrorStop; ++k) {
      const Given motion = any_motion(to);
      int periods = 0;
      ASSERT_TRUE(until([&] {
        if (disturbed) {
          disturb(periods++);
        }
        // While the tool gets back onto the belt it is beside the path.
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
      (known ? good : bad) += 1;
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
