// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

namespace Shearbox {

// Project version and git commit.
std::string version();

// Empty if the running LAMMPS is the one compiled against, with ids of the same size and the same MPI, else what is
// wrong. Asks through LAMMPS's C interface only: before this check the layout of its classes can't be trusted.
std::string mismatch(void *lmp);

} // namespace Shearbox
