// SPDX-License-Identifier: GPL-2.0-or-later
// fix cdem/grains: made by fix cdem/integrate, not by the user. Has the state of the grains that LAMMPS's own arrays
// lack: which atoms are grains and which are walls, angle and acceleration of each, its inertia, and how a time step is
// made. The fix stays when fix cdem/integrate is defined anew, so grains keep their angles. The state migrates with the
// grains and is in restart files.
#pragma once

#include "core/disc_motion.h"
#include "host/glides.h"

#include "atom.h"
#include "fix.h"

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

  // Data files get a section with the angles, since LAMMPS reads no file with a section that it does not know: without
  // the angles, clumps would be read as others.
  void angles_matter(bool yes) { wd_section = yes; }

  // --- of each atom ---
  // Turned so far, rad; NaN of a grain that has just been made.
  double angle(int i) const { return state[i][ANGLE]; }
  double &angle(int i) { return state[i][ANGLE]; }
  // At the end of the last step (m/s^2, rad/s^2); x is NaN as long as it is not known.
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
    return {inverses[i].mass * atom->f[i][0], inverses[i].mass * atom->f[i][1],
            inverses[i].inertia * atom->torque[i][2]};
  }
  // Whether the acceleration is that of the present step; else the first step takes it from the forces.
  bool knows_acceleration(int i) const;
  void accelerations_are_of_this_step();
  void forget_accelerations() { kept.valid_step = -1; }

  // --- mass and inertia ---
  // 1/m (1/kg) and 1/I (1/(kg m^2)) of an own atom, 0 for walls: divisions that are done once for many steps.
  struct Inverse {
    double mass, inertia;
  };
  const Inverse &inverse(int i) const { return inverses[i]; }
  void set_inverses();
  // Moment of inertia of a grain of this type over m r^2, r the circumscribed radius.
  double inertia(int type) const { return inertias[type]; }
  void set_inertias(const std::vector<double> &by_type) { inertias = by_type; }

  // --- how the time is stepped ---
  // Gravity (m/s^2), drag (1/s), and the share of half a step by which the dashpots' velocity is carried forward (see
  // core/stability.h).
  double gravity[2] = {0, 0}, drag = 0, weight = 0;
  cdem::StepRule step_rule() const;

  int setmask() override { return 0; }
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

  enum Column { AX, AY, ALPHA, ANGLE, NCOLUMNS };

private:
  double **state = nullptr; // NCOLUMNS per atom
  Fix *mover = nullptr;
  std::vector<Inverse> inverses;
  std::vector<double> inertias; // by type
  struct {
    bigint valid_step = -1; // the step at whose end the accelerations were taken
  } kept;                   // what restart files keep
};

} // namespace LAMMPS_NS
