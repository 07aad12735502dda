// SPDX-License-Identifier: GPL-2.0-or-later
// pair_style cdem law direct|incremental [limit_damping yes|no] [instructions avx512|avx2|baseline]
// pair_coeff I J kn ks hn hs phi
//
// Contact law of discs, and of grains made of discs (fix cdem/shape), in the plane with accumulated tangential force,
// after Matsunae, Seguro, Yoshida (2012), eqs. 2 and 3; see core/contact_law.h for the formulas.
//
//   law            direct: normal force from the overlap; incremental: summed from displacement increments (Cundall)
//   limit_damping  yes: the normal force never pulls; no (default): the dashpot may pull as a contact opens
//   instructions   instruction set of the loop over the contacts (default: the widest this machine has); avx512 and
//                  avx2 give the same bits, baseline on x86-64 does not: it has no fused multiply-add
//   kn, ks         normal and tangential stiffness, N/m; kn > 0, ks >= 0
//   hn, hs         damping ratios of the pair, >= 0; the dashpot is 2 h sqrt(m k)
//   phi            friction angle, degrees, 0 <= phi < 90
//
// m is m_i m_j/(m_i + m_j), or m_i against a wall: an atom outside the group of fix cdem/integrate. Walls never act on
// each other. Needs dimension 2, atom_style sphere (radii cannot change in a run), newton off, comm_modify vel yes, fix
// cdem/integrate, and units in which force is mass times acceleration: si, cgs, lj, micro or nano.
// single() and contacts() read the last step and change nothing. eng_vdwl is the elastic energy of the springs.
#pragma once

#include "contacts/fix_cdem_history.h"
#include "core/disc_pairs.h"
#include "core/force_kernel.h"
#include "grains/grain_rows.h"

#include "pair.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

class FixCDEMAudit;
class FixCDEMGrains;

class PairCDEM : public Pair, public ContactList {
public:
  // A contact of the last step. t = n turned by +90 degrees; the force on disc a is fn n + ft t. One that opened within
  // the step is still there, with what is left of its forces and an overlap below zero.
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
  int pack_forward_comm(int, int *, double *, int, int *) override;
  void unpack_forward_comm(int, int, double *) override;
  double memory_usage() override;

  const cdem::Material &material(int itype, int jtype) const { return materials[itype][jtype]; }
  // A disc of one of this rank's own grains, at the end of the last step.
  struct DiscPlace {
    int atom, disc;
    double x, y, radius;
  };

  std::vector<Contact> contacts() const;
  std::vector<DiscPlace> discs() const;
  // Calls visit(row of the other disc, 2 sqrt(m) of the pair) for all that touches a disc of an own grain, in the order
  // of the sums.
  template <class Visit> void for_each_touching(int row, Visit visit) const {
    slots.for_each(row, [&](int k) {
      if (overlap(k) > 0)
        visit(pairs.a(k) == row ? pairs.b(k) : pairs.a(k), 2 * std::sqrt(mass(k)));
    });
  }
  struct SpringEnergy {
    double normal, tangential; // J
  };
  SpringEnergy spring_energy() const; // of the contacts that this rank counts
  void book_losses();                 // of the same, with fix cdem/audit, if there is one
  bool keeps_books() const { return booking; }
  // To be called when the time step has changed: the dashpots go with it.
  void renew_constants();

  void copy_history_to_grains() override;
  void move_history_to_grains() override;
  void close_list() override;

  // What a step consists of, for run style cdem, which steps the rows alone while nothing else asks for the atoms.
  GrainRows rows;
  void exchange_ghosts(); // the rows of ghosts, from their owners
  void forces();          // adds to f and torque of own grains
  // The same, but moves the rows of own grains; f of these own walls only. Adds to what they have travelled, unless
  // null.
  void forces_and_advance(const cdem::StepRule &, const std::vector<int> &felt, cdem::Fastest &, cdem::Travel *);
  // How far any grain may still move before LAMMPS's list misses a pair of grains (m); less than 0: it may miss one
  // now.
  double room() const;
  double largest_reach() const;
  // To be called before the forces if rows have moved, no point of a grain by more than this since the last call (m).
  void refresh_list(double moved);

private:
  void allocate();
  void check_setting() const;
  void check_atoms() const;
  void check_periods() const;

  void build_list();
  void choose_skin();
  void divide_into_blocks();
  template <class Visit> void for_each_candidate(int i, Visit) const;
  void find_pairs();
  void refuse_same_centre(int p, int q) const;
  void set_constants();
  void recall_history(int k);
  int most_pairs() const;

  void pair_forces(int block);
  void keep_forces(int block);
  void finish_step_in_books();
  void tally();

  double mass(int k) const; // the reduced one of the two grains
  double overlap(int k) const;
  bool acts(int k) const;
  SpringEnergy spring_energy(int k, const cdem::Material &) const;
  Contact contact(int k) const;
  bool counts(int k) const;

  cdem::Law law = cdem::Law::direct;
  bool limit_damping = false;
  std::string instructions;
  std::vector<std::vector<cdem::Material>> materials; // by the types of the two atoms
  std::vector<double> largest_radius;                 // by type

  FixCDEMGrains *grains = nullptr;
  FixCDEMHistory *history = nullptr;
  FixCDEMAudit *audit = nullptr;
  bool booking = false; // whether the list was built for an audit

  // Where a grain was when LAMMPS's list of grain pairs was built, and this style's of disc pairs. The latter has a
  // smaller skin and also ages when a grain turns. Each rank rebuilds it for itself, without any communication.
  struct Place {
    double x, y;
    double moved(const cdem::Disc<double> &) const;
  };
  double most_moved() const;
  std::vector<Place> neighbours_built_at; // of own grains
  std::vector<Place> discs_built_at;      // of all grains
  std::vector<double> angle_built_at;     // of all grains, empty unless clumps
  double list_skin = 0;                   // discs no further apart than this are in the list (m)
  double list_room = 0;                   // at least so far may any point of a grain still move (m)
  double list_speed = -1;                 // at which the farthest got away from the last list (m a step), -1: unknown
  bigint list_step = 0;                   // when the list was built
  bool list_of_run = false;               // whether it was built in this run

  std::vector<tagint> listed;    // ids of all grains, ghosts too, when the list of disc pairs was built
  std::vector<int> block_starts; // grains block_starts[k] ... block_starts[k+1]-1 are block k
  struct Found {
    int p, q, segment;
  };
  std::vector<Found> found; // pairs of rows for the list, those of the lower id first
  cdem::DiscPairs pairs;
  cdem::ForceSlots slots;
  cdem::Kernels kernels{};
  bool fetches_ahead = false; // see core/disc_pairs.h
  bool history_in_list = false;
};

} // namespace LAMMPS_NS
