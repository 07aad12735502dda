// SPDX-License-Identifier: GPL-2.0-or-later
// run_style verlet/cdem
//
// Velocity Verlet, to the same bits as run_style verlet, but several times faster for pair style cdem: as long as
// nothing else looks at the atoms, steps are made on the rows of the pair style alone, the forces of a block of grains
// and their motion in one go. LAMMPS's own arrays are brought up to date for every step with output, for a fix or a
// variable that acts at the end of a step, and for a rebuild of the neighbour list. A step with a rebuild, and one for
// which somebody wants energy or virial of the pairs, is run_style verlet's.
//
// The neighbour list is rebuilt before any grain can have moved out of it, whatever neigh_modify every and check say;
// should a grain have more than quadrupled its speed in just that step, it counts as a dangerous build.
//
// A fix that acts within every step, such as gravity or viscous, leaves no steps to be made this way: then this is
// run_style verlet, and a warning names the fix. Those that say that they may be glided over (host/glides.h) are no
// hindrance: the fixes of this package, except fix cdem/lid with a variable for its stress.
#pragma once

#include "core/disc_motion.h"

#include "verlet.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

class DiscPairList;
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
  bool acts_in_every_step(int ifix) const;
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
  std::vector<int> felt; // own wall discs whose forces matter in every step

  bool can_glide = false;
  bigint run_start = 0;
  cdem::StepRule rule{};
  double reach = 0;     // largest of all grains
  double stride = 0;    // no point of a grain moved further in the last step (m)
  double room = 0;      // of the list when it was last measured
  double travelled = 0; // by the fastest since then
};

} // namespace LAMMPS_NS
