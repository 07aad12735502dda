// SPDX-License-Identifier: GPL-2.0-or-later
// Computes and fixes of LAMMPS that take a grain for a point, a circle or a sphere, or a contact for a central force,
// and so have wrong values beside pair style cdem. A warning says so, once per style and run, and names ours.
#pragma once

namespace LAMMPS_NS {

class LAMMPS;

// What is in the scene: grains of several discs, and walls, which do not act on each other.
struct Scene {
  bool clumps, walls;
};

void warn_of_misreaders(LAMMPS *, const Scene &);

} // namespace LAMMPS_NS
