// SPDX-License-Identifier: GPL-2.0-or-later
// compute ID group cdem/energy [audit yes|no]
//
// Global vector (J):
//
//   1 translation  sum of m v^2/2 over the group
//   2 rotation     sum of I omega^2/2 over the group; I = m r^2/2 for a disc, or as fix cdem/shape has it, times the
//                  factor `inertia` of fix cdem/integrate
//   3 springs      sum of e_n^2/(2 k_n) + e_s^2/(2 k_s), and of the energy stored in additions to the law (rolling,
//                  cohesion), over all contacts, whatever the group
//
// and with `audit yes` (default: no), of all grains that fix cdem/integrate moves, since the first run with the audit:
//
//   4 tangential   the part of 3 that is e_s^2/(2 k_s)
//   5 friction     lost where contacts slide, or roll at the limit of the rolling resistance
//   6 dashpots     lost in the dashpots
//   7 drag         lost to drag and local damping of fix cdem/integrate
//   8 walls        work that the walls of fixes cdem/lid and cdem/move did on the grains
//   9 gravity      work of the gravity of fix cdem/integrate
//   10 residual    the increase of the energy of the grains and springs since then, plus 5 to 7, less 8 and 9
//
// Work and losses are sums over steps of the mean force at the two ends of the step times its displacement, as the time
// integration does work. So the residual is the error of the time step, of second order (of first order with law
// incremental, whose normal spring need not be empty as a contact opens), and anything that the audit does not count:
// forces of other fixes, grains that are added, removed or given a velocity.
//
// An audit costs some time in every step and 32 bytes per pair (40 with rolling resistance). Its sums are in restart
// files: after read_restart, make the compute before the first run. The last digits of sums depend on the number of
// ranks.
//
// Scalar: the sum of 1 to 3 (J). It is constant, up to the error of the time step, as long as there is no damping,
// sliding, body force or moving wall. Needs atom_style sphere and pair_style cdem. Only one compute may have an audit,
// and its first run must not be `pre no`.
#pragma once

#include "grains/fix_cdem_audit.h"

#include "compute.h"

#include <array>

namespace LAMMPS_NS {

class FixCDEMGrains;
class PairCDEM;

class ComputeCDEMEnergy : public Compute, public FixCDEMAudit::Opener {
public:
  ComputeCDEMEnergy(LAMMPS *, int, char **);
  ~ComputeCDEMEnergy() override;

  void init() override;
  double compute_scalar() override;
  void compute_vector() override;

  void open_books() override;
  void take_gravity() override;
  void book_losses() override;

private:
  enum Part { TRANSLATION, ROTATION, SPRINGS, NPARTS };
  enum Audit { TANGENTIAL = NPARTS, FRICTION, DASHPOTS, DRAG, WALLS, GRAVITY, RESIDUAL, NALL };

  // Of all grains that fix cdem/integrate moves, at present (J).
  struct State {
    double kinetic, springs, tangential;
  };
  State state() const;
  double work_of_gravity(double gx, double gy) const; // sum of m g.x of the same grains (J)
  struct Kinetic {
    double translation, rotation;
  };
  Kinetic kinetic(int i) const;
  void keep_books();
  void refuse_lost_audit() const;

  PairCDEM *pair = nullptr;
  FixCDEMGrains *grains = nullptr;
  FixCDEMAudit *audit = nullptr;
  std::array<double, NALL> energy{};
};

} // namespace LAMMPS_NS
