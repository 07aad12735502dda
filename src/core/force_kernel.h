// SPDX-License-Identifier: GPL-2.0-or-later
// The forces of a range of pairs of one material. The loop is compiled once for each instruction set of the machine's
// family and chosen at run time; all give the same bits, since every operation in it is rounded as IEEE 754 says and
// none is fused.
#pragma once

#include "contact_law.h"

namespace cdem {

// Columns of a list of pairs, one entry a pair. All are aligned to 64 bytes, and so are the ranges of one material:
// entries up to the next multiple of LANES may be read and written.
struct PairColumns {
  static constexpr int LANES = 8;

  const int *a, *b;
  const double *radius_sum, *radius_difference, *root_mass;
  double *es, *en;
  Forces<double> *force;
};

// The range is begin ... end-1, begin a multiple of LANES.
using ForceKernel = void (*)(const Disc<double> *discs, const PairColumns &, const Material &, int begin, int end,
                             double dt);

// The fastest one that this machine can run.
ForceKernel force_kernel(Law, bool limit_damping);

} // namespace cdem
