// SPDX-License-Identifier: GPL-2.0-or-later
// run_style verlet/cdem
//
// Velocity Verlet, with the same bits as run_style verlet, but several times faster for pair style cdem. (In a box with
// a periodic side the last bits may differ: they do with the steps in which LAMMPS shifts grains by a period, and the
// neighbour list is rebuilt in other ones.) As long as nothing else reads the atoms, steps are made on the rows of the
// pair style alone (the run glides): the forces of a block of grains and their motion are computed together. LAMMPS's
// own arrays are brought up to date for every step with output, for a fix or a variable that acts at the end of a step,
// and for a rebuild of the neighbour list. A step with a rebuild, or in which energy or virial of the pairs is needed,
// is made by run_style verlet.
//
// The neighbour list is rebuilt before any grain can have moved too far for it, whatever neigh_modify every and check
// say. Only a grain that has more than quadrupled its speed in just that step can be too far: then the rebuild counts
// as dangerous.
// A fix that acts within every step, such as gravity or viscous, leaves no steps to be made this way. Then this style
// is as run_style verlet, and a warning names the fix. Fixes that may be left out of such steps (host/glides.h) do not
// matter: these are the fixes of this package, except fix cdem/lid with a variable for its stress, and fix
// cdem/integrate with `damping` while there is an audit. A fix that changes the size or the shape of the box, such as
// deform, ends it as well. Needs pair_style cdem. With KOKKOS turned on (-k on -sf kk) LAMMPS allows no run style but
// its own, verlet/kk, which gives the same bits.
#pragma once

#include "core/disc_motion.h"

#include "verlet.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

class DiscPairList;
class Fix;
class FixCDEMGrains;
class FixCDEMIntegrate;
class SumsSteps;
class WallBody;

class VerletCDEM : public Verlet {
public:
  VerletCDEM(LAMMPS *, int, char **);

  void init() override;
  void run(int) override;

private:
  std::string hindrance() const; // what makes all steps those of run_style verlet; empty if nothing does
  static bool acts_in_every_step(const Fix &, int mask);
  bigint next_look() const;
  bigint next_rebuild() const;

  bool stopped();
  bool glide_to(bigint look);
  void finish_step();
  void glide(bigint target);
  void glide_on(bigint target);
  void find_walls();
  void begin_step();
  void step(cdem::Fastest &);
  void move_walls(cdem::Fastest &);
  void measure_room();
  bool rebuild_is_due(int steps, const cdem::Fastest &);

  DiscPairList *contacts = nullptr;
  FixCDEMGrains *grains = nullptr;
  FixCDEMIntegrate *integrate = nullptr;
  std::vector<WallBody *> wall_bodies;
  std::vector<SumsSteps *> statistics;
  std::vector<int> felt; // own wall discs whose forces are needed in every step

  bigint run_start = 0;
  cdem::StepRule rule{};
  double reach = 0;     // largest distance of a disc's centre from that of its own grain (m)
  double stride = 0;    // bound on the motion of any point of a grain in the last step (m)
  double room = 0;      // how far any grain could still move when it was last measured (m), see DiscPairList::room
  double travelled = 0; // sum of `stride` since then (m)
};

} // namespace LAMMPS_NS
