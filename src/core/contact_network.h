// SPDX-License-Identifier: GPL-2.0-or-later
// A time step that is stable with the present contacts of a packing: a close bound on the largest one, never above it.
//
// With the dashpots at the half step (stability.h), the packing is stable as long as no motion u of all grains has
//
//   u.(K dt^2 + 2 C dt) u > 4 u.M u,    K, C: sums over the contacts of k (g.u)^2 and c (g.u)^2,
//
// where g.u = g_i.u_i - g_j.u_j is the relative motion of the two grains along the normal or the tangent, or their
// rotation against each other. For any weights y > 0 of the grains,
//
//   (g.u)^2 <= (1 + y_j/y_i) (g_i.u_i)^2 + (1 + y_i/y_j) (g_j.u_j)^2.
//
// So the grains can be looked at one by one: the packing is stable if for each of them the largest eigenvalue of
//
//   B_i = M_i^-1 sum over its contacts of (1 + y_j/y_i) (k dt^2 + 2 c dt) g_i g_i
//
// is at most 4. y = 1 gives Gershgorin's bound. The best weights follow from repeating y_i <- y_i |B_i|, the power
// method on a matrix without negative entries (Perron, Frobenius; the bounds are those of Collatz and Wielandt). The
// step found in any round is safe. A wall does not move: y = 0. Sliding contacts count as if they stuck.
#pragma once

#include "declaration.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace cdem {

// A symmetric 3 x 3 matrix, the sum of weight d d^T over directions d = (x, y, turn), and its largest eigenvalue, or
// slightly more: Newton's method approaches the largest root of the characteristic polynomial from above, beginning at
// the trace.
class Squares {
public:
  void add(double weight, double x, double y, double turn) {
    xx += weight * x * x, yy += weight * y * y, tt += weight * turn * turn;
    xy += weight * x * y, xt += weight * x * turn, yt += weight * y * turn;
  }
  double largest() const {
    const double minors = xx * yy - xy * xy + xx * tt - xt * xt + yy * tt - yt * yt;
    const double determinant = xx * (yy * tt - yt * yt) - xy * (xy * tt - xt * yt) + xt * (xy * yt - xt * yy);
    const double trace = xx + yy + tt;
    double root = trace;
    for (int k = 0; k < 20; k++) {
      const double value = ((root - trace) * root + minors) * root - determinant;
      const double slope = (3 * root - 2 * trace) * root + minors;
      if (!(value > 1e-12 * trace * trace * trace && slope > 0))
        break;
      root -= value / slope;
    }
    return root;
  }

private:
  double xx = 0, yy = 0, tt = 0, xy = 0, xt = 0, yt = 0;
};

// A contact, seen from one of its two grains.
struct Touch {
  int other;     // the other grain, own or ghost
  double nx, ny; // unit normal
  double ox, oy; // contact point, relative to the centre of the grain (m)
  Resistance resistance;
};

template <class Packing> class ContactNetwork {
public:
  // The contacts are computed from the packing anew in every round: to store them in this form would take more memory
  // than the list of pairs. A Packing has
  //
  //   own()                       number of own grains
  //   inverse(i)                  1/mass and 1/inertia of an own grain as .mass and .inertia, 0 for a wall
  //   for_each_touch(i, visit)    calls visit(Touch) for all contacts of own grain i
  explicit ContactNetwork(const Packing &p) : packing(p) {}

  // A stable step (s), improved from a first guess `step`; stops early once it has found `enough` (s). INFINITY if
  // there are no contacts.
  //   weights     room for one number of each own grain and ghost
  //   to_ghosts() copies the weights of own grains to their ghosts on other ranks
  //   largest(x)  returns the largest x of all ranks
  // Combines grains by maxima only, so the result is the same for any number of ranks.
  template <class ToGhosts, class Largest>
  double step_limit(double step, double enough, std::vector<double> &weights, ToGhosts to_ghosts,
                    Largest largest) const {
    constexpr int ROUNDS = 10;
    const int n = packing.own();
    for (int i = 0; i < n; i++)
      weights[i] = packing.inverse(i).mass > 0 ? 1 : 0;
    std::vector<double> loads(n);
    double best = 0;
    for (int round = 0; round < ROUNDS && best < enough; round++) {
      to_ghosts();
      double most = 0;
      for (int i = 0; i < n; i++)
        most = std::max(most, loads[i] = load(i, step, weights));
      most = largest(most);
      if (!(most > 0))
        return INFINITY;
      for (int i = 0; i < n; i++)
        weights[i] *= loads[i] / most;
      // with the same weights, a step f > 1 times as long has at most f^2 times the load, one f < 1 times as long at
      // most f times
      step *= most > ALLOWED ? ALLOWED / most : std::sqrt(ALLOWED / most);
      best = std::max(best, step);
    }
    return best;
  }

private:
  static constexpr double ALLOWED = 4;

  static double load(const Resistance::Part &p, double dt) { return (p.stiffness * dt + 2 * p.dashpot) * dt; }

  double load(int i, double dt, const std::vector<double> &weights) const {
    const auto inverse = packing.inverse(i);
    if (inverse.mass == 0)
      return 0;
    const double by_mass = std::sqrt(inverse.mass), by_inertia = std::sqrt(inverse.inertia);
    Squares sum;
    packing.for_each_touch(i, [&](const Touch &t) {
      const auto &[normal, tangent, turning] = t.resistance;
      const double factor = 1 + weights[t.other] / weights[i], x = t.nx * by_mass, y = t.ny * by_mass;
      sum.add(factor * load(normal, dt), x, y, (t.ox * t.ny - t.oy * t.nx) * by_inertia);
      sum.add(factor * load(tangent, dt), -y, x, (t.ox * t.nx + t.oy * t.ny) * by_inertia);
      if (turning.stiffness > 0 || turning.dashpot > 0)
        sum.add(factor * load(turning, dt), 0, 0, by_inertia);
    });
    return sum.largest();
  }

  const Packing &packing;
};

} // namespace cdem
