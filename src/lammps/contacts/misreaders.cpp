// SPDX-License-Identifier: GPL-2.0-or-later
#include "contacts/misreaders.h"

#include "comm.h"
#include "compute.h"
#include "error.h"
#include "fix.h"
#include "lammps.h"
#include "modify.h"

#include <algorithm>
#include <string>

using namespace LAMMPS_NS;

namespace {

struct Misreader {
  const char *style;
  bool (*is_wrong)(const Scene &);
  const char *why, *instead;
};

bool always(const Scene &) { return true; }
bool clumps(const Scene &s) { return s.clumps; }
bool clumps_or_walls(const Scene &s) { return s.clumps || s.walls; }

constexpr const char *SPHERES = "the moment of inertia of a sphere, 0.4 m r^2, not that of the grains";
constexpr const char *POINTS = "grains as points, without their own rotation";
constexpr const char *CENTRES = "centres within one distance, not contacts";

const Misreader computes[] = {
    {"erotate/sphere", always, SPHERES, "compute cdem/energy"},
    {"erotate/sphere/atom", always, SPHERES, "compute cdem/energy"},
    {"temp/sphere", always, SPHERES, "compute cdem/energy"},
    {"angmom/chunk", always, POINTS, "compute cdem/energy for the rotation"},
    {"inertia/chunk", always, POINTS, "compute cdem/energy for the rotation"},
    {"omega/chunk", always, POINTS, "compute cdem/average for the spin"},
    {"torque/chunk", always, POINTS, "fix ave/chunk with tqz for the grains' own torques"},
    {"group/group", always, "no friction, and normal forces along the line of the grains' centres; its scalar is right",
     "compute cdem/contacts"},
    {"pair/local", always,
     "no friction in fx fy and, of clumps, forces along the line of their centres; eng and p1 p2 p3 are right",
     "compute cdem/contacts"},
    {"property/local", always, "neighbours, not contacts", "compute cdem/contacts"},
    {"contact/atom", clumps_or_walls, "circles around grains that overlap, also of two walls",
     "compute cdem/contacts or cdem/average"},
    {"coord/atom", always, CENTRES, "compute cdem/average"},
    {"cluster/atom", always, CENTRES, "compute cdem/contacts"},
    {"fabric", always, "an anisotropy of three dimensions, of circles around grains that overlap, also of two walls",
     "compute cdem/average"},
    {"centroid/stress/atom", always, "nothing of this pair style", "compute stress/atom or cdem/grid"},
    {"heat/flux", always, "no work of friction on the spin of grains", "compute cdem/energy"},
};

const Misreader fixes[] = {
    {"pair/tracker", always, "no contact of this pair style", "compute cdem/contacts"},
    {"wall/gran", clumps, "the circle around a clump", "walls of discs, outside the group of fix cdem/integrate"},
    {"wall/gran/region", clumps, "the circle around a clump",
     "walls of discs, outside the group of fix cdem/integrate"},
};

// `style_of(k)` is the style of the k-th of `count` computes or fixes in the deck.
template <std::size_t N, class StyleOf>
void warn(LAMMPS *lmp, const char *kind, const Misreader (&known)[N], const Scene &scene, int count, StyleOf style_of) {
  for (const auto &[style, is_wrong, why, instead] : known) {
    const std::string name = style;
    bool used = false;
    for (int k = 0; k < count; k++)
      used = used || name == style_of(k);
    if (used && is_wrong(scene))
      lmp->error->warning(FLERR, "Pair style cdem: {} {} sees {}; take {}", kind, style, why, instead);
  }
}

} // namespace

void LAMMPS_NS::warn_of_misreaders(LAMMPS *lmp, const Scene &scene) {
  if (lmp->comm->me != 0)
    return;
  const Modify &m = *lmp->modify;
  warn(lmp, "compute", computes, scene, m.ncompute, [&](int k) { return m.compute[k]->style; });
  warn(lmp, "fix", fixes, scene, m.nfix, [&](int k) { return m.fix[k]->style; });
}
