// SPDX-License-Identifier: GPL-2.0-or-later
// A lid pushed inward by a constant force: free fall up to its largest speed, then uniform motion.
#include "core/lid_motion.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

constexpr double DT = 0.125, FASTEST = 2; // exact in binary

struct Fall {
  double place = 0;
  cdem::LidMotion lid;

  void take(int steps, double acceleration) {
    lid.acceleration = acceleration;
    for (int n = 0; n < steps; n++) {
      lid.begin_step(DT, FASTEST);
      place += DT * lid.velocity;
      lid.acceleration = acceleration;
      lid.end_step(DT, FASTEST);
    }
  }
};

TEST(LidMotion, FallsFreelyBelowItsLargestSpeed) {
  Fall fall;
  fall.take(10, -1);
  EXPECT_EQ(fall.lid.velocity, -10 * DT);
  EXPECT_EQ(fall.place, -0.5 * std::pow(10 * DT, 2));
  EXPECT_EQ(fall.lid.capped_steps, 0);
}

TEST(LidMotion, MovesUniformlyAtItsLargestSpeed) {
  Fall fall;
  fall.take(16, -1); // has just reached it
  EXPECT_EQ(fall.lid.velocity, -FASTEST);
  EXPECT_EQ(fall.lid.capped_steps, 0);
  const double reached = fall.place;
  fall.take(7, -1);
  EXPECT_EQ(fall.place - reached, -FASTEST * 7 * DT);
  EXPECT_EQ(fall.lid.acceleration, 0);
  EXPECT_EQ(fall.lid.capped_steps, 7); // each once, also where both halves of the kick are cut
}

TEST(LidMotion, CountsAStepWhoseFirstHalfAloneIsCut) {
  Fall fall;
  fall.take(16, -1);
  fall.lid.acceleration = -1;
  fall.lid.begin_step(DT, FASTEST);
  fall.lid.acceleration = 1; // the grains bear it now
  fall.lid.end_step(DT, FASTEST);
  EXPECT_EQ(fall.lid.velocity, -FASTEST + 0.5 * DT);
  EXPECT_EQ(fall.lid.capped_steps, 1);
}

TEST(LidMotion, IsNotLimitedOutward) {
  Fall fall;
  fall.take(100, 1);
  EXPECT_EQ(fall.lid.velocity, 100 * DT);
}

} // namespace
