// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

namespace LAMMPS_NS {
class Command;
class Compute;
class Dump;
class Fix;
class Integrate;
class LAMMPS;
class Pair;
} // namespace LAMMPS_NS

namespace Shearbox {

// One style of the package: its kind ("pair", "fix", "compute", "command", "run" as LAMMPS's plugin loader spells
// them, and "dump", which it does not know), its name in input files, and the creator that belongs to its kind; the
// others are null.
struct Style {
  const char *kind, *name;
  LAMMPS_NS::Pair *(*pair)(LAMMPS_NS::LAMMPS *) = nullptr;
  LAMMPS_NS::Fix *(*fix)(LAMMPS_NS::LAMMPS *, int, char **) = nullptr;
  LAMMPS_NS::Compute *(*compute)(LAMMPS_NS::LAMMPS *, int, char **) = nullptr;
  LAMMPS_NS::Dump *(*dump)(LAMMPS_NS::LAMMPS *, int, char **) = nullptr;
  LAMMPS_NS::Command *(*command)(LAMMPS_NS::LAMMPS *) = nullptr;
  LAMMPS_NS::Integrate *(*run)(LAMMPS_NS::LAMMPS *, int, char **) = nullptr;
};

const std::vector<Style> &styles();

} // namespace Shearbox

// The same under a name that the plugin can look up in cdemstyles.so.
extern "C" const std::vector<Shearbox::Style> *shearbox_styles();
