// SPDX-License-Identifier: GPL-2.0-or-later
// pair_style cdem law direct|incremental [limit_damping yes|no]
// pair_coeff I J kn ks hn hs phi
//
// Contact law of discs in the plane with accumulated tangential force, after Matsunae, Seguro, Yoshida (2012), eqs. 2
// and 3; see core/contact_law.h for the formulas.
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

#include "pair.h"

#include <vector>

namespace LAMMPS_NS {

class FixCDEMHistory;
class FixCDEMIntegrate;

class PairCDEM : public Pair {
 public:
  // A contact of the last step. t = n turned by +90 degrees; the force on disc a is fn n + ft t.
  struct Contact {
    tagint tag_a, tag_b;
    int disc_a, disc_b;
    double x, y;      // contact point
    double fn, ft;    // with dashpots; fn > 0 repels
    double nx, ny;    // from b to a
    double overlap;
    bool sliding;
    bool mine;    // of the ranks that see this contact, this one counts it
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
  std::vector<Contact> contacts() const;
  double elastic_energy() const;    // of the contacts that this rank counts, J

  void store_history();      // from the list to the grains
  void release_history();    // the same, and the list is no longer the place where it is kept

 private:
  struct Candidate {
    int a, b, material;
  };

  void allocate();
  void check_setting() const;
  void fill_rows();
  void build_list();
  std::vector<Candidate> find_candidates() const;
  void sort_by_material(const std::vector<Candidate> &);
  void set_constants(int k);
  void recall_history(int k);
  void sum_forces();
  void tally();
  double spring_energy(int k, const cdem::Material &) const;
  bool touches(int k) const;
  Contact contact(int k, const cdem::Material &) const;
  bool counts(int k) const;

  cdem::Law law = cdem::Law::direct;
  bool limit_damping = false;
  std::vector<std::vector<cdem::Material>> materials;    // by the types of the two atoms
  std::vector<double> largest_radius;                    // by type

  FixCDEMIntegrate *integrate = nullptr;
  FixCDEMHistory *history = nullptr;

  std::vector<cdem::Disc<double>> rows;    // the discs of owned atoms, then of ghosts
  cdem::DiscPairs pairs;
  cdem::ForceSums sums;
  bool history_in_list = false;
};

}    // namespace LAMMPS_NS
