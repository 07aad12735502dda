// SPDX-License-Identifier: GPL-2.0-or-later
// What a contact law tells the rest of the program about itself; laws.h lists the laws.
#pragma once

#include <limits>

namespace cdem {

// A number that pair_coeff gives for two atom types.
struct Parameter {
  const char *name, *unit;
  bool zero_allowed = true; // negative values never are
  double below = std::numeric_limits<double>::infinity();
};

// A number that a contact remembers from step to step, as seen from the disc of the grain with the lower id. `odd`: it
// changes its sign when the two grains change places. Names have 15 letters at most: restart files hold them.
struct Remembered {
  const char *name, *unit;
  bool odd = false;
};

// The two grains of a contact (kg, kg m^2), and the radii of the discs that touch (m). Mass and inertia of a wall are
// infinite.
struct TwoGrains {
  struct Grain {
    double mass, inertia, radius;
  } a, b;
};

// 1/(1/x + 1/y); one of them may be infinite.
inline double reduced(double x, double y) { return 1 / (1 / x + 1 / y); }

// How a contact resists the motion of its grains, for the stability limit: along its normal and its tangent (N/m,
// N s/m), and when they turn against each other (N m, N m s).
struct Resistance {
  struct Part {
    double stiffness = 0, dashpot = 0;
  } normal, tangent, turning;
};

} // namespace cdem
