// SPDX-License-Identifier: GPL-2.0-or-later
// fix ID group cdem/integrate [dt check|any|auto [MAX]] [gravity GX GY] [drag T|none]
// fix_modify ID gravity GX GY
// fix_modify ID drag T|none
//
// Velocity Verlet for grains in the plane, with inertia I = m r^2/2 for a disc, or as fix cdem/shape has it. Atoms
// outside the group are walls: contacts don't move them. Exactly one fix of this style must exist.
//
//   dt check     refuse a time step beyond the stability limit of the scene (default)
//   dt any       run with any time step
//   dt auto MAX  set the time step to the smaller of 0.9 x limit and MAX (s, default: no maximum)
//   gravity      acceleration of the grains (m/s^2, default 0 0)
//   drag         of a medium at rest: force -m v/T on each grain, T > 0 (s, default: none); v is the half step's
//
// Scalar: stability limit of the scene (s), see core/stability.h.
// Per-atom array: 1, 2 acceleration (m/s^2), 3 angular acceleration (rad/s^2), 4 angle turned so far (rad).
// A run that goes on, also after a restart, starts from the stored acceleration and so continues to the same bits.
#pragma once

#include "core/disc_motion.h"

#include "atom.h"
#include "fix.h"
#include "update.h"

#include <vector>

namespace LAMMPS_NS {

class FixCDEMAudit;
class GrainRows;

class FixCDEMIntegrate : public Fix {
public:
  enum Column { AX, AY, ALPHA, ANGLE, NCOLUMNS };

  // The fix of this style, or null.
  static FixCDEMIntegrate *find(LAMMPS *);

  FixCDEMIntegrate(LAMMPS *, int, char **);
  ~FixCDEMIntegrate() override;

  int setmask() override;
  int modify_param(int, char **) override;
  void init() override;
  void reset_dt() override;
  void setup(int) override;
  void post_neighbor() override;
  void initial_integrate(int) override;
  void post_force(int) override;
  void final_integrate() override;
  double compute_scalar() override;

  double memory_usage() override;
  void grow_arrays(int) override;
  void copy_arrays(int, int, int) override;
  void set_arrays(int) override;
  int pack_exchange(int, double *) override;
  int unpack_exchange(int, double *) override;
  void write_restart(FILE *) override;
  void restart(char *) override;
  int pack_restart(int, double *) override;
  void unpack_restart(int, int) override;
  int size_restart(int) override;
  int maxsize_restart() override;

  bool is_free(int i) const { return atom->mask[i] & groupbit; }
  // Whether the stored acceleration belongs to the present state; else the first step takes it from the forces.
  bool knows_acceleration(int i) const;
  cdem::StepRule step_rule() const;
  bool has_body_forces() const { return gravity[0] != 0 || gravity[1] != 0 || drag != 0; }

  // 1/m and 1/I of an own grain, 0 of walls.
  struct Inverse {
    double mass, inertia;
  };
  const Inverse &inverse(int i) const { return inverses[i]; }
  // Of a step made on rows: what drag takes out, if there is an audit.
  void book_drag(const GrainRows &);
  // Has the neighbour list rebuilt in the next step.
  void rebuild_next() { next_reneighbor = update->ntimestep + 1; }

  double **state = nullptr; // NCOLUMNS per atom

private:
  enum class Step { check, any, automatic };

  template <class Value> double scene_minimum(Value) const;
  void refuse_second_integrator() const;
  void parse_step_rule(int narg, char **arg, int &iarg);
  int parse_body_force(int narg, char **arg);
  double number(const char *keyword, int narg, char **arg, int &iarg) const;
  void apply_step_rule();
  void take_acceleration(int i);

  template <class Velocity> void book_drag_at(Velocity);

  FixCDEMAudit *audit = nullptr;
  std::vector<Inverse> inverses;

  Step rule = Step::check;
  double max_step;
  double limit = 0;
  double weight = 0; // share of half a step by which the dashpots' velocity is carried forward, see core/stability.h
  double gravity[2] = {0, 0}, drag = 0; // m/s^2, 1/s
  std::vector<double> inertia;          // over mass radius^2, by type
  std::vector<int> to_start;            // grains whose acceleration was not known at setup
  bigint valid_step = -1;               // the step at whose end `state` was written
};

} // namespace LAMMPS_NS
