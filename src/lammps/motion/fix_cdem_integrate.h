// SPDX-License-Identifier: GPL-2.0-or-later
// fix ID group cdem/integrate [dt check|any|auto [MAX]|contacts [MAX]] [gravity GX GY] [drag T|none]
//                             [damping A] [inertia F] [rescue FILE|none]
// fix_modify ID gravity GX GY
// fix_modify ID drag T|none
// fix_modify ID damping A
//
// Velocity Verlet for grains in two dimensions, with inertia I = m r^2/2 for a disc, or as fix cdem/shape has it. Atoms
// outside the group are walls: contacts do not move them. A wall that no fix moves stays where it is, and its velocity
// and spin act as those of a belt or a roller. Since a grain that leaves the group keeps its own, a warning tells of
// such walls. Exactly one fix of this style must exist, and no other integrator may move its grains. Needs dimension 2,
// atom_style sphere and pair_style cdem.
//
//   dt check     refuse a time step beyond the stability limit of the scene (default)
//   dt any       run with any time step
//   dt auto MAX  set the time step to the smaller of 0.9 x limit and MAX (s, default: no maximum)
//   dt contacts MAX
//                set it to the smaller of MAX and 0.8 x the limit of the present contacts (compute cdem/limit),
//                for a packing that is at rest and will not become much denser. Without any contact, the step is that
//                of dt auto. It is chosen as the first run with contacts begins, and kept: a fix with the same ID that
//                continues from a restart file has the same step
//   gravity      acceleration of the grains (m/s^2, default 0 0)
//   drag         of a medium at rest: force -m v/T on each grain, T > 0 (s, default: none); v is the velocity of the
//                half step
//   damping      local damping (Cundall 1987; PFC and YADE have it): of each grain, each component of the force from
//                contacts, gravity and drag, and the torque, is lowered by a share A of it, 0 <= A < 1, while it drives
//                the motion (has the sign of the velocity of the half step), and raised by it while it resists. Not a
//                force of nature: for states of equilibrium, in which it vanishes, not for grains that fall or flow
//                (default 0). Stability limits are lower with it, by 1/sqrt(1 + A) or more: dt auto takes a smaller
//                step
//   inertia      factor on the moment of inertia of all grains, F > 0 (default: 1), to study how rolling depends on it
//   rescue       restart file to write when the run fails (default: rescue.restart in the current folder; none beyond
//                100000 atoms per rank, since the copies from which it is written take about 630 bytes per atom)
//
// A run that blows up ends with an error that names the step and an atom. The atom has moved by more than a tenth of
// the smallest disc's radius in one step, has a position, velocity or force that is not a finite number, or has left
// the box (unless thermo_modify says that lost atoms are no error). All atoms are checked on every rebuild of the
// neighbour list and at least every 100 steps (run_style verlet/cdem: the fastest in every step). The restart file then
// has a state from 5000 to 10000 steps before, or from the start of the run, with the history of contacts and the state
// of fixes: the run can be continued from there with a smaller step.
//
// A step that is only a little beyond the limit does not blow up: contacts chatter, grains stay in motion and lie less
// dense, and nothing else shows. So at the start and every 5000 steps the step is compared with the limit of the
// present contacts (compute cdem/limit), and a warning is given, once in a run. This also finds a case that the limit
// of the scene does not cover: a large grain among a dozen or more small wall discs.
//
// Scalar: stability limit of the scene (s), that of the worst packing, see core/stability.h; infinite without grains.
// Per-atom array: 1, 2 acceleration (m/s^2), 3 angular acceleration (rad/s^2), 4 angle turned so far (rad).
//
// A run that is continued, also after a restart, begins with the forces of the last step, in its first output too, and
// so gives the same bits, whatever step number it has (in a periodic box: those of the run that wrote the restart
// file). Energy and pressure of the contacts are those that setup computes, where dashpots follow other velocities. If
// anything has been changed since (grains moved, deleted, of another mass or velocity; coefficients, gravity, time
// step, box) it begins with those of the scene as it is. Where grains were moved relative to each other, as by set or
// read_dump, contacts keep their springs and grains their angles, which a warning tells. A run that is "pre no" must
// have the atoms, group, types, radii and masses of the one before. The forces of other fixes are taken anew at the
// start of each run: those that depend on velocities, such as viscous, change the last bits. rerun is refused, and so
// is a run of clumps without the fix cdem/shape that they had.
#pragma once

#include "grains/fix_cdem_grains.h"
#include "host/glides.h"
#include "motion/body_forces.h"
#include "motion/guard.h"
#include "motion/step_choice.h"

#include "fix.h"
#include "update.h"

#include <string>

namespace LAMMPS_NS {

class DiscPairList;

class FixCDEMIntegrate : public Fix, public Glides {
public:
  // The fix of this style, or null.
  static FixCDEMIntegrate *find(LAMMPS *);

  FixCDEMIntegrate(LAMMPS *, int, char **);
  ~FixCDEMIntegrate() override;

  void post_constructor() override;
  int setmask() override;
  int modify_param(int, char **) override;
  void init() override;
  void reset_dt() override;
  void setup_pre_exchange() override;
  void setup_post_neighbor() override;
  void setup_pre_force(int) override;
  void setup(int) override;
  void pre_exchange() override;
  void post_neighbor() override;
  void initial_integrate(int) override;
  void setup_pre_reverse(int, int) override;
  void pre_reverse(int, int) override;
  void final_integrate() override;
  void end_of_step() override;
  void post_run() override;
  double compute_scalar() override;
  int pack_forward_comm(int, int *, double *, int, int *) override;
  void unpack_forward_comm(int, int, double *) override;
  double memory_usage() override;
  void write_restart(FILE *) override;
  void restart(char *) override;

  bool needs_every_step() const override { return body_forces.books_forces(); }
  // Ends a run without a setup that is not prepared for the atoms that there are.
  void check_preparation();
  // Has the neighbour list rebuilt in the next step.
  void rebuild_next() { next_reneighbor = update->ntimestep + 1; }
  // Stability limit of the present contacts (s), all ranks together.
  double contact_limit() { return step.contacts.find(step.scene_limit(), INFINITY); }

  Guard guard;
  BodyForces body_forces;

private:
  void set_rescue(const std::string &file);
  void take_grains();
  void tell_grains();
  void settle_angles();
  void tell_rules();
  void refuse_second_integrator() const;
  void refuse_lost_shapes() const;
  void warn_of_belts() const;
  void take_accelerations();
  double smallest_disc() const;

  StepChoice step;
  DiscPairList *contacts = nullptr;
  FixCDEMGrains *grains = nullptr;
  double inertia_factor = 1;
  double known_dt = 0;      // s, for which the step has been checked
  bool goes_on = false;     // the run begins with the forces of the last step
  bool is_first = false;    // the next step is the first after a setup
  bool is_prepared = false; // this run has been set up, or needs no setup
};

} // namespace LAMMPS_NS
