// SPDX-License-Identifier: GPL-2.0-or-later
// pair_style gran model direct_accumulation|incremental_accumulation [limit_damping on|off]
// pair_coeff * *
//
// The contact law of pair_style cdem (core/contact_law.h) as a contact model of LIGGGHTS, for discs in two dimensions:
// normal force from the overlap (direct) or summed from displacement increments (incremental), and an accumulated
// tangential force with its own history: `tangential`, `rolling_friction`, `cohesion` and `surface` are not given.
//
//   limit_damping  on: the normal force never pulls; off (default): the dashpot may pull as a contact opens
//
// Needs these, each by fix property/global ... peratomtypepair NTYPES (value for each pair of types):
//
//   kn, kt               normal and tangential stiffness (N/m); kn > 0, kt >= 0
//   hn, hs               damping ratios of the pair (no unit), >= 0; the dashpot is 2 h sqrt(m k)
//   coefficientFriction  tangent of the friction angle, >= 0
//
// m is m_i m_j/(m_i + m_j), or m_i against a wall: an atom outside the group of fix cdem/integrate, which must exist.
// Walls never act on each other; neigh_modify exclude saves the time to find that out.
//
// Needs dimension 2, atom_style sphere, newton off and communicate single vel yes. Grains are single discs: LIGGGHTS's
// multisphere is three-dimensional. What a contact remembers is forgotten at once when it opens. On several ranks the
// last bits of sums depend on the ranks, as for all contact models of LIGGGHTS. compute pair/gran/local and compute pe
// (energy stored in springs, J) are right; fixes that have LIGGGHTS store contact forces are refused, and so is fix
// rigid. Walls are discs: fix wall/gran does not know these models.
#pragma once

#include "core/kinematics.h"
#include "core/material.h"

#include "contact_interface.h"
#include "granular_pair_style.h"
#include "pointers.h"

#include <string>
#include <vector>

namespace Liggghts {

class FixIntegrate;

class Accumulation : public LIGGGHTS::PairStyles::IGranularPairStyle, private LAMMPS_NS::Pointers {
public:
  static void register_models();
  // That of this LIGGGHTS; an error says that `who` needs one.
  static Accumulation &needed_by(const std::string &who, LAMMPS_NS::LAMMPS *);

  Accumulation(LAMMPS_NS::LAMMPS *, int accumulation);
  ~Accumulation() override;

  void settings(int, char **, LIGGGHTS::IContactHistorySetup *) override;
  void init_granular() override;
  void write_restart_settings(FILE *) override;
  void read_restart_settings(FILE *, int64_t) override;
  void compute_force(LAMMPS_NS::PairGran *, int eflag, int vflag, int addflag) override;
  int get_history_offset(const std::string name) override;
  double stressStrainExponent() override { return 1; }
  int64_t hashcode() override;
  bool contact_match(const std::string type, const std::string model) override;

  // The largest type of an atom: LIGGGHTS has properties of no others, whatever create_box says.
  int types() const { return stride - 1; }
  const cdem::Material &material(int itype, int jtype) const { return materials[itype * stride + jtype]; }

  // Of all contacts as they are, all ranks together.
  struct Sums {
    double contacts, normal_force, spring_energy; // number, N, J
  };
  Sums sums() const;

private:
  template <class Law> void forces(LAMMPS_NS::PairGran *, bool add_to_computes);
  template <class Law>
  cdem::Forces<double> force_of_pair(int i, int j, double dt, double of_steps, double *numbers, bool keeps) const;
  void check() const;

  const int accumulation;
  bool limit_damping = false;
  int es = 0, en = 0; // where the springs are in what a contact remembers
  int stride = 0;
  std::vector<cdem::Material> materials;
  double **kn = nullptr, **kt = nullptr, **hn = nullptr, **hs = nullptr, **mu = nullptr;
  FixIntegrate *motion = nullptr;
};

} // namespace Liggghts
