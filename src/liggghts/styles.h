// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "liggghts/host.h"

namespace Liggghts {

// Makes the fixes, computes and commands of Shearbox known to this LIGGGHTS.
void add_styles(LAMMPS *);

} // namespace Liggghts
