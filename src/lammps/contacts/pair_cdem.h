// SPDX-License-Identifier: GPL-2.0-or-later
// pair_style cdem law direct|incremental [limit_damping yes|no] [instructions avx512|avx2|baseline]
// pair_coeff I J kn ks hn hs phi [rolling mu_r h_r] [cohesion F_c]
//
// Contact law of discs, and of grains made of discs (fix cdem/shape), in two dimensions, with an accumulated tangential
// force; Matsunae, Seguro, Yoshida (2012), eqs. 2 and 3; see core/contact_law.h for the formulas.
//
//   law            direct: normal force from the overlap; incremental: summed from displacement increments (Cundall).
//                  Must be given
//   limit_damping  yes: the normal force never pulls; no (default): the dashpot may pull as a contact opens
//   instructions   instruction set of the loop over the contacts (default: the widest of this machine); avx512 and avx2
//                  give the same bits, baseline on x86-64 does not: it has no fused multiply-add
//   kn, ks         normal and tangential stiffness, N/m; kn > 0, ks >= 0
//   hn, hs         damping ratios of the pair (no unit), >= 0; the dashpot is 2 h sqrt(m k), N s/m
//   phi            friction angle, degrees, 0 <= phi < 90
//   rolling        rolling resistance: coefficient mu_r and damping ratio h_r of its dashpot (no unit), >= 0. Its
//                  spring has the stiffness 3 kn (mu_r R)^2 and bears a torque up to mu_r R kn overlap, where R is
//                  r_i r_j/(r_i + r_j), half the radius of equal discs (Ai, Chen, Rotter & Ooi 2011, type C). Contacts
//                  of types that do not name it have none (default)
//   cohesion       constant pull-off force F_c of discs that touch, N, >= 0: the normal force is kn overlap - F_c, and
//                  friction has its limit from kn overlap alone (Gilabert, Roux & Castellanos 2007). Default: none
//
// m is m_i m_j/(m_i + m_j), or m_i against a wall: an atom outside the group of fix cdem/integrate. Walls never act on
// each other.
//
// Needs dimension 2, atom_style sphere (radii cannot change in a run), atom ids, newton off, comm_modify vel yes, a
// skin above 0, fix cdem/integrate, and units in which force is mass times acceleration: si, cgs, lj, micro or nano.
// Radii and masses must be positive, z must be 0. A periodic box must be two diameters of the largest grain or more.
// minimize, rerun and pair_write are refused, and so are discs with the same centre. Every pair of types needs a
// pair_coeff, with I <= J.
//
// eng_vdwl is the energy stored in the contacts: in springs and in additions to the law (J). single(), as in compute
// pair/local, reads the last step and changes nothing: force (N/m: over the distance of the discs), p1 normal and p2
// tangential force with their dashpots, p3 tangential spring (N), summed over the discs of two grains. It is one force
// along the line of the centres, so what LAMMPS makes of it lacks friction. A warning as a run begins names the
// computes and fixes of LAMMPS that are wrong here, and those of ours that are right (misreaders.cpp has the list).
// Computes pe, pe/atom, pair, pressure, stress/atom, ke and those of places and velocities are right.
#pragma once

#include "contacts/contact_report.h"
#include "contacts/disc_pair_list.h"
#include "contacts/law_choice.h"
#include "contacts/misreaders.h"
#include "core/stability.h"

#include "pair.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

class FixCDEMGrains;
class FixCDEMHistory;

class PairCDEM : public Pair {
public:
  // The pair style. An error says that `who` needs it if there is another one, or none.
  static PairCDEM *needed_by(const std::string &who, LAMMPS *);

  explicit PairCDEM(LAMMPS *);
  ~PairCDEM() override;

  void settings(int, char **) override;
  void coeff(int, char **) override;
  void init_style() override;
  double init_one(int, int) override;
  virtual double atom2cut(int); // no override: 4Jul2026 asks for neither any more
  virtual double radii2cut(double, double);
  void compute(int, int) override;
  double single(int, int, int, int, double, double, double, double &) override;
  void write_restart(FILE *) override;
  void read_restart(FILE *) override;
  int pack_forward_comm(int, int *, double *, int, int *) override;
  void unpack_forward_comm(int, int, double *) override;
  double memory_usage() override;

  // Law and coefficients of all pairs of types, as text.
  std::string rules() const { return law.text(setflag); }
  const cdem::Material &material(int itype, int jtype) const { return law.coefficients[itype][jtype].material; }
  // Atom i surrounded by equal grains, with contacts between its type and `other_type`: for the stability limit.
  cdem::AmongItsLike among_its_like(int i, int other_type) const;

  DiscPairList contacts; // with the rows of the grains, on which run style verlet/cdem makes its steps
  ContactReport report;

private:
  void allocate();
  void check_setting() const;
  void check_atoms() const;
  void check_lines() const;
  void check_turning_walls() const;
  bool resists_slip(const cdem::Coefficients &) const;
  void check_periods() const;
  void find_largest_radii();
  Scene scene() const;
  void tally(int k, const cdem::PairForce &);

  LawChoice law;
  std::vector<double> largest_radius; // by type
  FixCDEMGrains *grains = nullptr;
  FixCDEMHistory *history = nullptr;
};

} // namespace LAMMPS_NS
