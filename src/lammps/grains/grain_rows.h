// SPDX-License-Identifier: GPL-2.0-or-later
// The grains as the contact law reads them. A row is the record of a disc: position and velocities (cdem::Disc). There
// is a row for each grain, own ones and then ghosts. If any grain has several discs (a clump), there is also a row for
// each disc. Between two rebuilds of the neighbour list, run_style verlet/cdem makes steps on the rows alone; otherwise
// the rows are filled from the atoms' arrays in every step.
#pragma once

#include "core/column.h"
#include "core/disc_motion.h"
#include "core/force_kernel.h"
#include "core/grain_shape.h"

#include "atom.h"
#include "pointers.h"

#include <vector>

namespace LAMMPS_NS {

class FixCDEMGrains;

class GrainRows : protected Pointers {
public:
  static constexpr int COMM_SIZE = 9; // doubles that a ghost is sent: its row and its angle

  explicit GrainRows(LAMMPS *lmp) : Pointers(lmp) {}

  void init(FixCDEMGrains *, const cdem::Kernels &);

  // After a rebuild of the neighbour list: gives every grain and disc its row.
  void map();

  bool has_clumps() const { return clumps; }
  // Rows are in the order of the atoms; rows_of(n) is the number of rows of the first n. If all grains are single
  // discs, row i is that of atom i.
  int rows_of(int natoms) const { return clumps ? first_row[natoms] : natoms; }
  int grain(int row) const { return clumps ? grain_of_row[row] : row; }
  int disc(int row) const { return clumps ? row - first_row[grain_of_row[row]] : 0; }
  double radius(int row) const { return clumps ? radii[row] : atom->radius[row]; }
  double reach(int i) const; // from the grain's centre to that of its furthest disc (m)
  const cdem::Disc<double> *discs() const { return clumps ? disc_rows.data() : grains.data(); }
  const cdem::Disc<double> &operator[](int row) const { return discs()[row]; }
  const cdem::Disc<double> &of_grain(int i) const { return grains[i]; }
  const cdem::Body *body(int i) const { return bodies.data() + i; }
  double angle(int i) const { return bodies[i].angle; } // only if there are clumps (rad)

  // Fills the rows of own grains begin ... end-1 from the atoms' arrays; the dashpots' velocity is carried forward by
  // the time `forward` (s). The rows of ghosts are received, and then expanded to their discs.
  void fill(int begin, int end, double forward);
  int pack(int n, const int *list, double *buf, int pbc_flag, const int *pbc) const;
  void unpack(int n, int first, const double *buf);
  void expand_ghosts();

  // Sums the forces on the discs of a block of grains, or of one grain, with the same bits. Then force_on() gives the
  // force on such a grain and the torque about its centre.
  void sum_block(const cdem::SlotBlock &, int first_grain, int end_grain);
  void sum_grain(const cdem::ForceSlots &, int i);
  cdem::DiscForce force_on(int i);

  // Moves wall grains by a step, without rotation: by their displacement (m), with the velocity of the step and that of
  // the dashpots (m/s).
  struct Vector {
    double x, y;
  };
  void shift(const std::vector<int> &walls, Vector displacement, Vector velocity, Vector ahead);

  // For steps on the rows alone. take_bodies() copies angle and mass of own grains from the atoms. advance() sums the
  // forces on grains begin ... end-1, which are a block, and moves them by a step. write_back() copies positions,
  // angles and velocities of the half step to the atoms.
  void take_bodies();
  void advance(const cdem::SlotBlock &, int begin, int end, const cdem::StepRule &, cdem::Fastest &, cdem::Travel *);
  void write_back();
  cdem::Fastest fastest(int n) const; // of the first n grains

  double bytes() const;

private:
  void fill_grain(int i, double forward);
  int make_sums(int first_grain, int end_grain); // makes room for the sums of their discs; returns how many
  void expand(int begin, int end);
  cdem::ClumpColumns columns();

  FixCDEMGrains *states = nullptr;
  cdem::Kernels kernels{};
  bool clumps = false;                          // whether any type has more than one disc
  std::vector<const cdem::GrainShape *> shapes; // by type
  std::vector<int> first_row, grain_of_row;     // empty unless clumps

  cdem::Column<cdem::Disc<double>> grains, disc_rows;
  cdem::Column<cdem::Body> bodies;         // of grains
  cdem::Column<cdem::Offset> offsets;      // of discs
  std::vector<double> radii;               // of discs, empty unless clumps
  cdem::Column<cdem::Forces<double>> sums; // of own discs, from first_summed on
  int first_summed = 0;
};

} // namespace LAMMPS_NS
