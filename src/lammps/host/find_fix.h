// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "lammps.h"
#include "modify.h"

namespace Shearbox {

// The first fix of this class, or null.
template <class T> T *find_fix(LAMMPS_NS::LAMMPS *lmp) {
  for (int i = 0; i < lmp->modify->nfix; i++)
    if (auto *fix = dynamic_cast<T *>(lmp->modify->fix[i]))
      return fix;
  return nullptr;
}

} // namespace Shearbox
