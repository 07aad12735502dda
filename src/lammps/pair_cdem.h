// SPDX-License-Identifier: GPL-2.0-or-later
// pair_style cdem law direct|incremental [limit_damping yes|no]
// pair_coeff I J kn ks hn hs phi
//
// Contact law of discs, and of grains made of discs (fix cdem/shape), in the plane with accumulated tangential force,
// after Matsunae, Seguro, Yoshida (2012), eqs. 2 and 3; see core/contact_law.h for the formulas.
//
//   law            direct: normal force from the overlap; incremental: summed from displacement increments (Cundall)
//   limit_damping  yes: the normal force never pulls; no (default): the dashpot may pull as a contact opens
//   kn, ks         normal and tangential stiffness, N/m; kn > 0, ks >= 0
//   hn, hs         damping ratios of the pair, >= 0; the dashpot is 2 h sqrt(m k)
//   phi            friction angle, degrees, 0 <= phi < 90
//
// m is m_i m_j/(m_i + m_j), or m_i against a wall: an atom outside the group of fix cdem/integrate. Walls never act on
// each other. Needs dimension 2, atom_style sphere, newton off, comm_modify vel yes and fix cdem/integrate.
// single() and contacts() read the last step and change nothing. eng_vdwl is the elastic energy of the springs.
#pragma once

#include "core/disc_pairs.h"
#include "core/force_sums.h"
#include "core/grain_shape.h"

#include "pair.h"

#include <vector>

namespace LAMMPS_NS {

class FixCDEMHistory;
class FixCDEMIntegrate;

class PairCDEM : public Pair {
public:
  // A contact of the last step. t = n turned by +90 degrees; the force on disc a is fn n + ft t. One that opened within
  // the step is still there, with what is left of its dashpot and an overlap below zero.
  struct Contact {
    tagint tag_a, tag_b;
    int disc_a, disc_b;
    double x, y;   // contact point
    double fn, ft; // with dashpots; fn > 0 repels
    double nx, ny; // from b to a
    double overlap;
    bool sliding;
    bool mine; // of the ranks that see this contact, this one counts it
  };

  explicit PairCDEM(LAMMPS *);
  ~PairCDEM() override;

  void settings(int, char **) override;
  void coeff(int, char **) override;
  void init_style() override;
  double init_one(int, int) override;
  void compute(int, int) override;
  double single(int, int, int, int, double, double, double, double &) override;
  void write_restart(FILE *) override;
  void read_restart(FILE *) override;
  void write_restart_settings(FILE *) override;
  void read_restart_settings(FILE *) override;
  double memory_usage() override;

  const cdem::Material &material(int itype, int jtype) const { return materials[itype][jtype]; }
  // A disc of one of this rank's own grains, at the end of the last step.
  struct DiscPlace {
    int atom, disc;
    double x, y, radius;
  };

  std::vector<Contact> contacts() const;
  std::vector<DiscPlace> discs() const;
  double elastic_energy() const; // of the contacts that this rank counts, J

  void store_history();   // from the list to the grains
  void release_history(); // the same, and the list is no longer the place where it is kept

private:
  struct Candidate {
    int a, b, material;
  };

  void allocate();
  void check_setting() const;
  void read_shapes();

  // Rows are the discs of owned grains, then of ghosts. Where all grains are single discs, a row is an atom.
  int rows_of(int natoms) const { return clumps ? first_row[natoms] : natoms; }
  int grain(int row) const { return clumps ? grain_of_row[row] : row; }
  int disc(int row) const { return clumps ? row - first_row[grain_of_row[row]] : 0; }
  double disc_radius(int row) const;
  bool row_before(int, int) const;

  void map_rows();
  void fill_disc_rows(double forward);
  void fill_clump_rows(double forward);
  bool turned_out_of_list() const;

  void build_list();
  void find_candidates();
  void add_candidate(int row_i, int row_j);
  void sort_by_material();
  void set_constants(int k);
  void recall_history(int k);

  void sum_disc_forces();
  void sum_clump_forces();
  void tally();

  double overlap(int k) const;
  bool acts(int k) const;
  double spring_energy(int k, const cdem::Material &) const;
  Contact contact(int k, const cdem::Material &) const;
  bool counts(int k) const;

  cdem::Law law = cdem::Law::direct;
  bool limit_damping = false;
  std::vector<std::vector<cdem::Material>> materials; // by the types of the two atoms
  std::vector<double> largest_radius;                 // by type

  FixCDEMIntegrate *integrate = nullptr;
  FixCDEMHistory *history = nullptr;

  bool clumps = false;                          // whether any type has more than one disc
  std::vector<const cdem::GrainShape *> shapes; // by type
  std::vector<int> first_row, grain_of_row;     // empty unless clumps
  struct Place {
    double x, y, angle, arm; // arm: to the furthest disc centre
  };
  std::vector<Place> built_at; // of the grains when the list was built, empty unless clumps

  cdem::Column<cdem::Disc<double>> rows;
  std::vector<Candidate> candidates;
  cdem::DiscPairs pairs;
  cdem::ForceKernel kernel = nullptr;
  cdem::ForceSums sums;
  bool history_in_list = false;
};

} // namespace LAMMPS_NS
