// SPDX-License-Identifier: GPL-2.0-or-later
// cdem/create TYPE row X1 Y1 X2 Y2 N diameter D density RHO
// cdem/create TYPE fill N region XLO XHI YLO YHI diameter DMIN DMAX power P density RHO seed S
//
// Makes discs as the command of that name does in LAMMPS (src/lammps/grains/cdem_create.h, with the same places for the
// same seed): a row of N discs, or N grains without overlap in a rectangle, whose diameters follow n(d) ~ d^P. RHO is
// an areal density (kg/m^2), lengths are in m. Known once pair_style gran has one of the accumulations.
#pragma once

#include "liggghts/host.h"

namespace Liggghts {

void create(LAMMPS *, int narg, char **arg);

} // namespace Liggghts
