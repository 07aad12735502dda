// SPDX-License-Identifier: GPL-2.0-or-later
// Grains of several discs (clumps): the force on a grain from the forces on its discs, and the motion of its discs from
// that of the grain. A grain of one disc is the case without offset, and gets the same bits.
#pragma once

#include "disc_motion.h"
#include "rotation.h"

namespace cdem {

// From the centre of the grain to the centre of the disc, at angle 0 (m).
struct Offset {
  double x, y;
};

// The arrays of grains and of their discs. A row is the record of a grain or disc (struct Disc). The discs of grain i
// are rows first_row[i] ... first_row[i+1]-1.
struct ClumpColumns {
  Disc<double> *grains;
  Body *bodies;
  const int *first_row;
  Disc<double> *discs;
  const Offset *offsets;
  const Forces<double> *sums; // total force on each disc, from disc `first_summed` on
  int first_summed;
};

// Force on a grain and torque about its centre: fx, fy, torque, and one unused value.
[[gnu::always_inline]] inline Four force_on(const ClumpColumns &c, int grain) {
  const Four centre = load_raw<Four>(&c.grains[grain].x);
  Four sum{}, moments{}; // [0], [1]: moments of fy and of fx; [2], [3] are not used
  for (int row = c.first_row[grain]; row < c.first_row[grain + 1]; row++) {
    const Four force = load_raw<Four>(&c.sums[row - c.first_summed].fx);
    sum += force;
    moments += (load_raw<Four>(&c.discs[row].x) - centre) * __builtin_shufflevector(force, force, 1, 0, 2, 3);
  }
  sum[2] += moments[0] - moments[1];
  return sum;
}

// A disc at offset o from the centre of its grain moves with v + omega x o. During the step, the offset was that of the
// half step, o - dt/2 omega x o, which adds dt/2 omega^2 o to the velocity of the half step. All this is linear in the
// offset at angle 0, (o.x, o.y). So the row of a disc is the row of its grain, plus o.x times a vector x, plus o.y
// times a vector y, which is x turned by a quarter.
[[gnu::always_inline]] inline void expand(const ClumpColumns &columns, int grain, const Rotation &turn,
                                          double half_step) {
  const Disc<double> &g = columns.grains[grain];
  const Eight centre = load_raw<Eight>(&g.x);
  const double c = turn.cosine, s = turn.sine, spin = g.omega_half, inward = half_step * spin * spin;
  const Eight x{c, s, c * inward - s * spin, s * inward + c * spin, -s * g.omega, c * g.omega, 0, 0};
  const Eight y = __builtin_shufflevector(x, x, 1, 0, 3, 2, 5, 4, 7, 6) * Eight{-1, 1, -1, 1, -1, 1, -1, 1};
  for (int row = columns.first_row[grain]; row < columns.first_row[grain + 1]; row++) {
    const Offset &o = columns.offsets[row];
    store_raw(&columns.discs[row].x, centre + (o.x * x + o.y * y));
  }
}

// Collects grains whose discs are to be placed, so that sine and cosine of several angles are computed at a time.
class Expansion {
public:
  [[gnu::always_inline]] Expansion(const ClumpColumns &c, double half) : columns(c), half_step(half) {}

  [[gnu::always_inline]] void add(int grain) {
    grains[n] = grain;
    angle[n++] = columns.bodies[grain].angle;
    if (n == ROOM)
      finish();
  }

  [[gnu::always_inline]] void finish() {
    double cosine[ROOM], sine[ROOM];
    for (int k = 0; k < (n + LANES - 1) / LANES * LANES; k++) {
      const Rotation turn = rotation(angle[k]);
      cosine[k] = turn.cosine;
      sine[k] = turn.sine;
    }
    for (int k = 0; k < n; k++)
      expand(columns, grains[k], {cosine[k], sine[k]}, half_step);
    n = 0;
  }

private:
  static constexpr int ROOM = 32, LANES = 8;

  const ClumpColumns columns;
  const double half_step;
  int n = 0, grains[ROOM];
  double angle[ROOM] = {};
};

// Places the discs of grains begin ... end-1.
[[gnu::always_inline]] inline void expand(const ClumpColumns &columns, int begin, int end, double half_step) {
  Expansion discs(columns, half_step);
  for (int i = begin; i < end; i++)
    discs.add(i);
  discs.finish();
}

} // namespace cdem
