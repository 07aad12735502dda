// SPDX-License-Identifier: GPL-2.0-or-later
// fix ID group cdem/integrate [dt check|any|auto [MAX]] [drag T|none]
// fix_modify ID drag T|none
// fix_modify ID omega W
//
// Velocity Verlet for discs in two dimensions, with inertia m r^2/2. Atoms outside the group are walls: contacts do not
// move them. Exactly one fix of this style must exist, and nothing else may move its grains. Needs pair_style gran with
// one of the accumulations (accumulation.h).
//
//   dt check     refuse a time step beyond the stability limit of the scene, core/stability.h (default)
//   dt any       run with any time step
//   dt auto MAX  set the time step to the smaller of 0.9 x limit and MAX (s, default: no maximum)
//   drag         of a medium at rest: force -m v/T on each grain, T > 0 (s, default: none); v is the velocity of the
//                half step
//   omega        sets the spin of all grains (rad/s); command set of LIGGGHTS cannot
//
// It gives the contacts the two velocities that the law takes: that of the half step, with which the grains have moved,
// and that at the time of the force, carried forward from it by the acceleration of the last step (core/kinematics.h).
// When a run begins both are the grains' velocities.
//
// Scalar: stability limit of the scene (s). Vector: 1 rotation rate of motion (Matsunae, Seguro, Yoshida 2012, eq. 6),
// the mean over grains that have moved of sum r |d theta| / sum sqrt(dx^2 + dy^2), over all steps since the fix was
// made; 2 unbalanced force: mean net force on a grain over mean normal force of a contact (no unit); 3, 4 kinetic
// energy of translation and of rotation, 5 energy in the springs (J). Per-atom array: 1, 2 acceleration (m/s^2), 3
// angular acceleration (rad/s^2), 4 path (m), 5 angle turned without regard to sign, 6 angle turned (rad). Restart
// files have none of them: all begin anew.
#pragma once

#include "core/kinematics.h"
#include "core/stability.h"
#include "liggghts/host.h"

#include "atom.h"

namespace Liggghts {

class Accumulation;

class FixIntegrate : public Fix {
public:
  FixIntegrate(LAMMPS *, int, char **);
  ~FixIntegrate() override;

  int setmask() override;
  int modify_param(int, char **) override;
  void init() override;
  void reset_dt() override;
  void setup_pre_force(int) override;
  void initial_integrate(int) override;
  void pre_force(int) override;
  void post_force(int) override;
  void final_integrate() override;
  double compute_scalar() override { return limit; }
  double compute_vector(int) override;
  void grow_arrays(int) override;
  void copy_arrays(int, int, int) override;
  void set_arrays(int) override;
  int pack_exchange(int, double *) override;
  int unpack_exchange(int, double *) override;
  int pack_comm(int, int *, double *, int, int *) override;
  void unpack_comm(int, int, double *) override;

  bool is_wall(int i) const { return !(atom->mask[i] & groupbit); }
  // Share of half a step by which the velocities of the dashpots are carried forward.
  double prediction_weight() const { return weight; }
  // The rows of the contact law; of ghosts too.
  cdem::Disc<double> disc(int i) const {
    const double *const x = atom->x[i], *const v = atom->v[i], *const ahead = velocities[i];
    return {x[0], x[1], v[0], v[1], ahead[0], ahead[1], atom->omega[i][2], ahead[2]};
  }
  // For walls: with which their velocity is carried forward (m/s^2).
  void set_acceleration(int i, double x, double y) { of_grain[i][X] = x, of_grain[i][Y] = y; }

private:
  enum Output { TRM, UNBALANCED, TRANSLATION, ROTATION, SPRINGS, NOUTPUTS };
  enum Column { X, Y, TURN, PATH, TURNED, ANGLE, NCOLUMNS };
  enum class Rule { check, any, automatic };

  template <class Value> double scene_minimum(Value) const;
  void read_drag(Words &);
  void set_spins(double omega);
  void choose_step();
  void carry_forward(double time);
  template <class Term> double sum_over_grains(Term) const;
  double mean_trm() const;
  double unbalanced() const;

  Rule rule = Rule::check;
  double max_step, limit = 0, weight = 1, drag = 0;
  double **of_grain = nullptr;   // NCOLUMNS numbers
  double **velocities = nullptr; // at the time of the force: vx, vy, omega
};

} // namespace Liggghts
