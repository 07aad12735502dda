// SPDX-License-Identifier: GPL-2.0-or-later
// fix cdem/grains: made by fix cdem/integrate, not by the user. Has the state of the grains that LAMMPS's own arrays
// lack: which atoms are grains and which are walls, angle and acceleration of each, its inertia, and how a time step is
// made. The fix stays when fix cdem/integrate is defined anew, so grains keep their angles. The state migrates with the
// grains and is in restart files.
//
// It also has the forces of the last step, on grains and walls: those of the contacts, gravity, drag and damping. A run
// begins with them, since setup cannot compute them again: in a step the dashpots follow other velocities, and the
// forces of a contact that closed within it count for a share of it. So runs cut in two give the bits of one. They hold
// only for the scene to which they belong: where each atom is, how it moves, mass, size, type and whether it is a
// grain, the rules (contact law, shapes, gravity, drag, damping, time step) and the periods of the box. If anything of
// it has changed, a run begins with the forces that setup computes.
#pragma once

#include "core/disc_motion.h"
#include "host/glides.h"

#include "atom.h"
#include "fix.h"

#include <array>
#include <cstdint>
#include <vector>

namespace LAMMPS_NS {

class FixCDEMGrains : public Fix, public Glides {
public:
  static constexpr const char *ID = "CDEM_GRAINS";

  // The fix of this style, or null.
  static FixCDEMGrains *find(LAMMPS *);
  // The same; makes it if there is none.
  static FixCDEMGrains *find_or_make(LAMMPS *);

  FixCDEMGrains(LAMMPS *, int, char **);
  ~FixCDEMGrains() override;

  // --- who moves: the group of fix cdem/integrate; all other atoms are walls ---
  // `mover` is fix cdem/integrate, which outputs the states as its per-atom array.
  void begin_moving(Fix *mover);
  void end_moving() { mover = nullptr; }
  bool are_moved() const { return mover; }
  bool is_free(int i) const { return atom->mask[i] & mover->groupbit; }
  int group_of_grains() const { return mover->igroup; }

  // --- of each atom ---
  // Turned so far, rad; NaN of a grain that has just been made.
  double angle(int i) const { return state[i][ANGLE]; }
  double &angle(int i) { return state[i][ANGLE]; }
  // At the end of the last step (m/s^2, rad/s^2).
  struct Acceleration {
    double x, y, turn;
  };
  Acceleration acceleration(int i) const { return {state[i][AX], state[i][AY], state[i][ALPHA]}; }
  void set_acceleration(int i, const Acceleration &a) {
    state[i][AX] = a.x;
    state[i][AY] = a.y;
    state[i][ALPHA] = a.turn;
  }
  Acceleration acceleration_by_forces(int i) const {
    const Inverse of = inverse(i);
    return {of.mass * atom->f[i][0], of.mass * atom->f[i][1], of.inertia * atom->torque[i][2]};
  }

  // --- the forces of the last step, and the scene to which they belong ---
  // In each step: that the forces are there, before fixes of others add theirs; and that the step has come to its end.
  void forces_are_there();
  void step_is_done() { scene_is_new = true; }
  // What the forces depend on beside the grains; from now on.
  void set_rules(std::uint64_t fingerprint) { rules = fingerprint; }
  // After a step, keeps the scene; all ranks together.
  void keep_scene();
  void copy_scene(); // the same for a copy of the atoms, after which the step may go on
  // Whether the scene is the one that was kept, on all ranks together. Commands may have moved an atom by a period of
  // the box, or by a rounding error (balance shift): then it is put back where it was.
  bool scene_is_as_kept();
  void restore_forces() const;
  // Whether grains have moved relative to each other since their places were kept, on all ranks together.
  bool moved_against_each_other() const;
  // Whether the atoms are not those of the last run, or others are grains, or their types, radii or masses are others:
  // what was prepared for that run is wrong for them. On all ranks together.
  bool has_new_members() const { return members() != members_of_run; }

  // --- mass and inertia ---
  // 1/m (1/kg) and 1/I (1/(kg m^2)) of an own atom, 0 for walls.
  struct Inverse {
    double mass, inertia;
  };
  Inverse inverse(int i) const {
    const double m = atom->rmass[i], r = atom->radius[i];
    return is_free(i) ? Inverse{1 / m, 1 / (m * r * r * inertias[atom->type[i]])} : Inverse{0, 0};
  }
  // Moment of inertia of a grain of this type over m r^2, r the circumscribed radius.
  double inertia(int type) const { return inertias[type]; }
  void set_inertias(const std::vector<double> &by_type) { inertias = by_type; }

  // Whether atoms may be other than single discs: clumps, or pieces of smooth walls.
  bool may_have_shapes() const { return kept.shapes != 0; }
  // Then data files get a section with the angles, since LAMMPS reads no file with a section that it does not know:
  // without the angles, clumps would be read as others.
  void set_shapes(bool yes);

  // --- how the time is stepped ---
  // Gravity (m/s^2), drag (1/s), local damping, and the share of half a step by which the dashpots' velocity is carried
  // forward (see core/stability.h).
  double gravity[2] = {0, 0}, drag = 0, damping = 0, weight = 0;
  cdem::StepRule step_rule() const;

  int setmask() override { return 0; }
  void post_run() override;
  double memory_usage() override;
  void grow_arrays(int) override;
  void copy_arrays(int, int, int) override;
  void set_arrays(int) override;
  void write_data_section_size(int, int &, int &) override;
  void write_data_section_pack(int, double **) override;
  void write_data_section_keyword(int, FILE *) override;
  void write_data_section(int, FILE *, int, double **, int) override;
  int pack_exchange(int, double *) override;
  int unpack_exchange(int, double *) override;
  void write_restart(FILE *) override;
  void restart(char *) override;
  int pack_restart(int, double *) override;
  void unpack_restart(int, int) override;
  int size_restart(int) override;
  int maxsize_restart() override;

  // The outputs of fix cdem/integrate, up to ANGLE; force (N) and torque (N m) of the last step; place in the scene
  // that was kept (m).
  enum Column { AX, AY, ALPHA, ANGLE, FX, FY, TORQUE, X, Y, NCOLUMNS };

private:
  struct Periods {
    double x, y, tilt; // m, 0: not periodic
  };
  struct Shift {
    double x, y;  // m, less whole periods
    bool periods; // whether there were any
  };
  void keep_forces();
  Periods periods() const;
  Shift less_periods(double dx, double dy) const;
  Shift shift_from_kept(int i) const;
  std::array<double, 2> shift_of_first() const;
  double rounding() const;
  template <class OfAtom> std::uint64_t sum_over_atoms(OfAtom of_atom) const;
  std::uint64_t fingerprint_of_grains() const;
  std::uint64_t fingerprint_of_rules() const;
  std::uint64_t members() const;

  double **state = nullptr; // NCOLUMNS per atom
  Fix *mover = nullptr;
  std::vector<double> inertias; // by type
  std::uint64_t rules = 0, members_of_run = 0;
  bool scene_is_new = false; // a step has been made since it was kept
  struct Kept {              // in restart files
    static constexpr int VERSION = 3;
    std::uint64_t grains = 0, rules = 0; // fingerprints of the scene
    double shapes = 0;
  } kept;
};

} // namespace LAMMPS_NS
