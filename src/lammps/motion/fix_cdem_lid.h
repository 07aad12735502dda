// SPDX-License-Identifier: GPL-2.0-or-later
// fix ID group cdem/lid stress SIGMA width W thickness T [from top|bottom|left|right] [vmax V|auto]
//
// A rigid lid under a constant normal stress. The discs of the group form one body that moves only along its normal,
// vertically for a lid on top of the grains: its mass M is the sum of theirs, and M dv/dt = N - F, with N the sum of
// contact forces outward (up, for a lid on top) and F = SIGMA W T inward. Velocity Verlet as in fix cdem/integrate, so
// the lid needs no servo and no gains. The applied stress is exact. The felt stress, that of the grains on the lid,
// differs from it only by the inertia of the lid, M dv/dt/(W T), and while the speed is limited to V.
//
//   SIGMA  normal stress, >= 0 (Pa); or v_name, an equal-style variable that is evaluated in every step
//   W, T   width and thickness on which it acts, > 0 (m)
//   from   side of the grains on which the lid is (default: top)
//   V      largest speed of the lid inward, > 0 (m/s). Default auto = F/sqrt(n kn M), kn the largest normal
//          stiffness, n the number of discs: if the lid hits a rigid bed with all discs at once at speed v, the force
//          of the impact is v sqrt(n kn M), so it is never more than F itself. Needs pair_style cdem. The speed outward
//          is not limited.
//
// A variable makes other boundaries of it. Of constant normal stiffness K (Pa/m), as rock or a pile's soil around a
// shear zone, with f_lid[3] the place of the lid and h0 that at which its stress is SIGMA:
//
//   variable spring equal 1e5+${K}*(f_lid[3]-${h0})
//   fix      lid lid cdem/lid stress v_spring width 0.1 thickness 0.01
//
// Of constant volume it is a lid that does not move, whose stress is the force on it: fix cdem/move with speed 0.
//
// stress, width and thickness must be given. The mass of the group must be positive; its discs must not be in the group
// of fix cdem/integrate, nor in that of another fix that moves atoms; a warning tells of fixes that set forces on them,
// such as setforce. Forces are summed to 10^-18 N, or to 40 bits of a load that is less than 10^-6 N. Needs dimension 2
// and atom_style sphere.
//
// Global vector: 1 applied stress (Pa), 2 felt stress = N/(W T) (Pa), 3 place of the inner face (m), for a lid on top
// the y of its lowest point, which goes on without a jump where the box is periodic along the normal, 4 velocity
// outward (m/s), 5 number of steps in which V limited the velocity, 6 force of the grains along the lid, f_x or f_y
// (N). Runs continued from restart files give the same bits; with a variable, if it is one of places and steps, like
// this one: what it reads of forces and velocities is not known yet as a run begins.
#pragma once

#include "core/lid_motion.h"
#include "motion/wall_body.h"

#include <string>

namespace LAMMPS_NS {

class FixCDEMLid : public WallBody {
public:
  FixCDEMLid(LAMMPS *, int, char **);

  void init() override;
  void setup(int) override;
  void initial_integrate(int) override;
  void final_integrate() override;
  double compute_vector(int) override;
  bool follows_forces() const override { return true; }
  // A stress variable may read the atoms.
  bool needs_every_step() const override { return !stress_variable.empty(); }
  void write_restart(FILE *) override;
  void restart(char *) override;

private:
  enum Output { APPLIED, FELT, FACE, VELOCITY, CAPPED_STEPS, FORCE_ALONG, NOUTPUTS };

  struct Saved {
    static constexpr int VERSION = 3;
    double capped_steps;
    Booked booked;
  };

  void read_stress(Shearbox::DeckWords &);
  void read_side(Shearbox::DeckWords &);
  double group_velocity() const;
  double largest_stiffness() const;
  double inner_face() const;
  double reach(int i) const;
  Vector outward(double amount) const;
  void update_stress();
  void take_acceleration();
  void start();
  double fastest() const;

  std::string stress_variable; // empty: constant
  int variable_index = -1;
  double stress = 0, width = 0, thickness = 0;
  Axis axis = Y;        // of the normal
  double sign = 1;      // of the direction outward along it
  double given_cap = 0; // 0: automatic

  double mass = 0;
  double cap_per_force = 0; // automatic cap over F
  double felt_force = 0;    // outward
  cdem::LidMotion motion;   // outward; its capped steps are in restart files
  bool is_first = false;    // the next step is the first of a run
};

} // namespace LAMMPS_NS
