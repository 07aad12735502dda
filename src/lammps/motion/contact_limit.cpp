// SPDX-License-Identifier: GPL-2.0-or-later
#include "motion/contact_limit.h"

#include "contacts/pair_cdem.h"
#include "core/contact_network.h"
#include "grains/fix_cdem_grains.h"
#include "host/compat.h"

#include "atom.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;

namespace {

// The contacts of the last forces, in the form that core/contact_network.h needs.
struct Packing {
  const DiscPairList &contacts;
  const FixCDEMGrains &grains;
  const cdem::PairsOfDiscs of_discs;
  int nlocal;

  int own() const { return nlocal; }

  // As if the mass were less, see core/stability.h.
  FixCDEMGrains::Inverse inverse(int i) const {
    const FixCDEMGrains::Inverse of = grains.inverse(i);
    return {(1 + grains.damping) * of.mass, (1 + grains.damping) * of.inertia};
  }

  template <class Visit> void for_each_touch(int i, Visit visit) const {
    const GrainRows &rows = contacts.rows;
    const cdem::Disc<double> &centre = rows.of_grain(i);
    for (int own = rows.rows_of(i); own < rows.rows_of(i + 1); own++)
      of_discs.for_each(own, [&](int k) {
        if (contacts.values.overlap(k) <= 0)
          return;
        const int other = contacts.pairs.a(k) == own ? contacts.pairs.b(k) : contacts.pairs.a(k);
        const double dx = rows[own].x - rows[other].x, dy = rows[own].y - rows[other].y;
        const double distance = std::sqrt(dx * dx + dy * dy), nx = dx / distance, ny = dy / distance;
        const double lever = 0.5 * (distance + rows.radius(own) - rows.radius(other));
        visit(cdem::Touch{rows.grain(other), nx, ny, rows[own].x - lever * nx - centre.x,
                          rows[own].y - lever * ny - centre.y, contacts.values.resistance(k)});
      });
  }
};

} // namespace

double ContactLimit::find(double guess, double enough) {
  weights.resize(atom->nlocal + atom->nghost);
  auto to_ghosts = [this] { Shearbox::forward_comm(lmp, carrier); };
  auto largest = [this](double x) {
    double most;
    MPI_Allreduce(&x, &most, 1, MPI_DOUBLE, MPI_MAX, world);
    return most;
  };
  const DiscPairList &contacts = PairCDEM::needed_by("Fix cdem/integrate", lmp)->contacts;
  const Packing packing{contacts, *FixCDEMGrains::find(lmp), contacts.slots.by_disc(contacts.pairs), atom->nlocal};
  return cdem::ContactNetwork(packing).step_limit(guess, enough, weights, to_ghosts, largest);
}

int ContactLimit::pack(int n, const int *list, double *buf) const {
  for (int k = 0; k < n; k++)
    buf[k] = weights[list[k]];
  return n;
}

void ContactLimit::unpack(int n, int first, const double *buf) { std::copy_n(buf, n, weights.begin() + first); }
