// SPDX-License-Identifier: Apache-2.0
// Jobs on random belts and tables, with holds, overrides, stops and emergency stops: the path is on the product by
// orocos-kdl, and no set point breaks a limit whatever happens. INDUROP_ROBOT_BELTS says how many runs,
// INDUROP_ROBOT_SEED from which one on.

#include <array>

#include "job_belt_cell.h"
#include "random_belts.h"

namespace indurop::robot {
namespace {

std::string numbers_of(const Eight& pose) {
  return fmt::format("POSE {:.6f} {:.6f} {:.6f} RPY {:.6f} {:.6f} {:.6f}", pose[0], pose[1], pose[2], pose[3], pose[4],
                     pose[5]);
}

class Random_job_belts : public JobOnBelt<RandomBelts> {
 protected:
  std::array<KDL::Vector, 3> places;
  int good = 0, bad = 0;

  std::string job_of(bool turns) {
    std::string job = "FRAME line = " + numbers_of(from) + "\nFRAME part = " + numbers_of(from) +
                      "\nPOINT BIN = POSE 500 0 400 RPY 180 0 180\n";
    for (std::size_t i = 0; i < places.size(); ++i) {
      places[i] = {between(-40, 40), between(-40, 40), between(60, 200)};
      job += fmt::format("POINT P{} = POSE {:.6f} {:.6f} {:.6f} RPY 180 0 180 IN part\n", i, places[i][0], places[i][1],
                         places[i][2]);
    }
    const std::string on =
        fmt::format("POSE {:.6f}, {:.6f}, {:.6f} RPY 0, 0, {:.6f}", on_it[0], on_it[1], on_it[2], on_it[5]);
    job += "MOVL BIN\nWAIT 0.5s\npart = line : " + on + "\nSET STEP = 1\nTRACK part ON " +
           (turns ? "TABLE 1 ABOUT" : "BELT 1 ALONG") + " line\nTRY\n";
    for (std::size_t i = 0; i < places.size(); ++i) {
      job += fmt::format("MOVL P{} SPEED {:.0f} mm/s\nSET STEP = {}\n", i, between(50, 400), i + 2);
    }
    return job + "TRACK OFF\nRECOVER\nSET FAILED = ERROR\nEND\nMOVL BIN\n";
  }
  // One run to its end, or to what ends it.
  void run(bool disturbed, bool stopped) {
    int periods = 0;
    ASSERT_TRUE(until(
        [&] {
          note_begin();
          const double at = *values["STEP"];
          if (!disturbed && (at == 2 || at == 3)) {
            const auto i = static_cast<std::size_t>(at) - 2;
            const KDL::Vector along = places[i + 1] - places[i];
            const double part = KDL::dot(tip() - places[i], along) / KDL::dot(along, along);
            if (*values["FAILED"] == 0 && cell.out.error == ErrorCode::Ok && cell.out.moving_by_job) {
              EXPECT_LT((tip() - places[i] - along * part).Norm(), near) << time;
            }
          }
          if (disturbed) {
            disturb(periods++ % 600);
          }
          if (stopped && tracked && one_of(150) == 0 && cell.out.moving_by_job) {
            stopped = false;
            if (one_of(3) == 0) {
              cell.in.emergency = true;
              hardness = kEmergency;
            } else {
              cell.ask(Service::JobStop);
            }
          }
          return (ended() && cell.out.state != GroupState::Moving && stands()) ||
                 cell.out.state == GroupState::ErrorStop;
        },
        20'000))
        << message() << " step " << *values["STEP"];
    cell.in.hold = false;
    cell.in.speed_override = 100;
    good += *values["STEP"] == 4 ? 1 : 0;
    bad += *values["STEP"] == 4 ? 0 : 1;
  }
};

TEST_F(Random_job_belts, The_path_is_on_the_product_and_no_limit_is_broken) {
  const int runs = number_of("INDUROP_ROBOT_BELTS", 40);
  const int seed = number_of("INDUROP_ROBOT_SEED", 1);
  for (int each = seed; each < seed + runs && !failed; ++each) {
    SCOPED_TRACE(each);
    random.seed(static_cast<unsigned>(each));
    const bool turns = one_of(3) == 0;
    choose_belt(turns);
    choose_origin(turns);
    from[4] = 0;
    table = turns;
    origin = frame_of(from);
    object = frame_of(on_it);
    hardness = 1;
    run_job(job_of(turns));
    const bool disturbed = one_of(2) == 0;
    const bool stopped = one_of(3) == 0;
    run(disturbed, stopped);
    good -= stopped && *values["STEP"] == 4 ? 1 : 0;
    bad -= stopped && *values["STEP"] != 4 ? 1 : 0;
  }
  fmt::print("{} jobs on products, {} that could not be\n", good, bad);
  EXPECT_GT(good, 2 * bad);
}

}  // namespace
}  // namespace indurop::robot
