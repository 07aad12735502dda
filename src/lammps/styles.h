// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

namespace LAMMPS_NS {
class Command;
class Compute;
class Fix;
class LAMMPS;
class Pair;
} // namespace LAMMPS_NS

namespace Shearbox {

// One style of the package: its kind ("pair", "fix", "compute", "command" as LAMMPS's plugin loader spells them), its
// name in input files, and the creator that belongs to its kind; the others are null.
struct Style {
  const char *kind, *name;
  LAMMPS_NS::Pair *(*pair)(LAMMPS_NS::LAMMPS *) = nullptr;
  LAMMPS_NS::Fix *(*fix)(LAMMPS_NS::LAMMPS *, int, char **) = nullptr;
  LAMMPS_NS::Compute *(*compute)(LAMMPS_NS::LAMMPS *, int, char **) = nullptr;
  LAMMPS_NS::Command *(*command)(LAMMPS_NS::LAMMPS *) = nullptr;
};

// All styles, for the program and for the plugin.
const std::vector<Style> &styles();

// Project version and git commit.
const char *version();

// Null if the running LAMMPS is the one compiled against, else what is wrong with it.
const char *mismatch(LAMMPS_NS::LAMMPS *);

} // namespace Shearbox
