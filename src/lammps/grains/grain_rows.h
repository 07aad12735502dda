// SPDX-License-Identifier: GPL-2.0-or-later
// The grains as the contact law reads them. A row is the record of a disc: position and velocities (cdem::Disc). There
// is a row for each grain, own ones and then ghosts. If any grain has several discs (a clump), there is also a row for
// each disc. Last come the feet of discs on lines of walls (contacts/line_feet.h), if there are any. Between two
// rebuilds of the neighbour list, run_style verlet/cdem makes steps on the rows alone; otherwise the rows are filled
// from the atoms' arrays in every step.
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
class Pair;

class GrainRows : protected Pointers {
public:
  static constexpr int COMM_SIZE = 9; // doubles that a ghost is sent: its row and its angle

  // `pair` sends rows to ghosts, by pack() and unpack().
  GrainRows(LAMMPS *lmp, Pair *pair) : Pointers(lmp), carrier(pair) {}

  void init(FixCDEMGrains *, const cdem::Kernels &);

  // After a rebuild of the neighbour list: gives every grain and disc its row.
  void map();

  bool has_clumps() const { return clumps; }
  bool has_lines() const { return lines; }
  // Rows are in the order of the atoms; rows_of(n) is the number of rows of the first n. If all grains are single
  // discs, row i is that of atom i.
  int rows_of(int natoms) const { return clumps ? first_row[natoms] : natoms; }
  int own_grains() const { return own; } // that have rows: atoms may have arrived since
  int grain(int row) const {
    const int r = row_or_piece(row);
    return clumps ? grain_of_row[r] : r;
  }
  int disc(int row) const {
    const int r = row_or_piece(row);
    return clumps ? r - first_row[grain_of_row[r]] : 0;
  }
  double radius(int row) const {
    const int r = row_or_piece(row);
    return radii.empty() ? atom->radius[r] : radii[r];
  }
  // Whether the row is a piece of a wall's line, and its axis.
  bool is_line(int row) const { return lines && shape_of(row).is_line(); }
  cdem::WallLine line(int row) const { return shape_of(row).axis(atom->radius[grain(row)]); }
  const cdem::GrainShape &shape_of_type(int type) const { return *shapes[type]; }
  double reach(int i) const; // from the grain's centre to that of its furthest disc (m)
  const cdem::Disc<double> *discs() const { return clumps ? disc_rows.data() : grains.data(); }
  const cdem::Disc<double> &operator[](int row) const { return discs()[row]; }
  const cdem::Disc<double> &of_grain(int i) const { return grains[i]; }
  const cdem::Body *body(int i) const { return bodies.data() + i; }
  double angle(int i) const { return bodies[i].angle; } // only if there are clumps (rad)

  // Adds rows for feet; each belongs to the piece of a line whose row is given. Earlier ones are gone.
  void make_feet(std::vector<int> pieces);
  int foot_row(int n) const { return first_foot + n; }
  cdem::Disc<double> &foot(int n) { return (clumps ? disc_rows : grains)[first_foot + n]; }

  // Fills the rows of own grains begin ... end-1 from the atoms' arrays; the dashpots' velocity is carried forward by
  // the time `forward` (s). The rows of ghosts are received, and then expanded to their discs.
  void fill(int begin, int end, double forward);
  int pack(int n, const int *list, double *buf, int pbc_flag, const int *pbc) const;
  void unpack(int n, int first, const double *buf);
  void exchange_ghosts();

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
  int row_or_piece(int row) const { return row < first_foot ? row : piece_of_foot[row - first_foot]; }
  const cdem::GrainShape &shape_of(int row) const { return *shapes[atom->type[grain(row)]]; }
  void map_clumps();
  void fill_grain(int i, double forward);
  int make_sums(int first_grain, int end_grain); // makes room for the sums of their discs; returns how many
  void expand(int begin, int end);
  cdem::ClumpColumns columns();

  Pair *const carrier;
  FixCDEMGrains *states = nullptr;
  cdem::Kernels kernels{};
  int own = 0, all = 0;                         // grains that have rows, without and with ghosts
  bool clumps = false;                          // whether any type has more than one disc
  bool lines = false;                           // whether any type is a piece of a line
  std::vector<const cdem::GrainShape *> shapes; // by type
  std::vector<int> first_row, grain_of_row;     // empty unless clumps
  int first_foot = 0;                           // rows from here on are feet
  std::vector<int> piece_of_foot;

  cdem::Column<cdem::Disc<double>> grains, disc_rows;
  cdem::Column<cdem::Body> bodies;         // of grains
  cdem::Column<cdem::Offset> offsets;      // of discs
  std::vector<double> radii;               // of discs; empty if they are those of the atoms
  cdem::Column<cdem::Forces<double>> sums; // of own discs, from first_summed on
  int first_summed = 0;
};

} // namespace LAMMPS_NS
