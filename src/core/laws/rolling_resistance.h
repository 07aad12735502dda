// SPDX-License-Identifier: GPL-2.0-or-later
// Rolling resistance: an elastic-plastic spring and a dashpot against the turning of two discs on each other (Iwashita
// & Oda 1998; type C of Ai, Chen, Rotter & Ooi 2011), as a torque M on one disc and -M on the other.
//
//   spring   M_k -= k_r dtheta,  |M_k| <= mu_r R e_n;   at the limit the discs roll and the dashpot is off
//   dashpot  M_d = -c_r dtheta/dt,   c_r = 2 h_r sqrt(J k_r)
//
// dtheta is the rotation of one disc against the other, R = r_a r_b/(r_a + r_b), and 1/J the sum of 1/(I + m r^2) of
// the two. The stiffness is that of a contact B wide whose normal springs are spread evenly over it: k_r = k_n B^2/12;
// it resists until one edge opens, at M = e_n B/6. So mu_r R = B/6 and k_r = 3 k_n (mu_r R)^2, as in Ai et al. for
// two dimensions.
#pragma once

#include "core/contact_law.h"

namespace cdem {

struct RollingResistance {
  static constexpr const char *NAME = "rolling";
  static constexpr std::array<Parameter, 2> PARAMETERS{{{"mu_r", "1"}, {"h_r", "1"}}};
  static constexpr std::array<Remembered, 1> REMEMBERS{{{"rolling", "N m", true}}};
  static constexpr int BOOKS = 1;
  static constexpr int CONSTANTS = 3; // of a pair
  enum { STIFFNESS, DASHPOT, ARM };

  static void set_constants(const double *parameter, const Material &m, const TwoGrains &g, double *constant) {
    const double arm = parameter[0] * reduced(g.a.radius, g.b.radius), stiffness = 3 * m.kn * arm * arm;
    auto about_rim = [](const TwoGrains::Grain &x) { return x.inertia + x.mass * x.radius * x.radius; };
    constant[STIFFNESS] = stiffness;
    constant[DASHPOT] = 2 * parameter[1] * std::sqrt(reduced(about_rim(g.a), about_rim(g.b)) * stiffness);
    constant[ARM] = arm;
  }

  template <class T> static T rate(const Contact<T> &c) { return c.turning_half; }

  template <class T, class Share, class Books>
  [[gnu::always_inline]] static void act(const Contact<T> &c, const Share &share, const NormalSpring<T> &e_n,
                                         const T *constant, T *memory, double dt, Action<T> &action, Books &books,
                                         std::size_t book) {
    const T before = memory[0], limit = constant[ARM] * e_n.pressing;
    const T trial = fused(T(-dt) * constant[STIFFNESS] * rate(c), share.spring, before);
    const auto holds = magnitude(trial) < limit;
    const T spring = select(holds, trial, with_sign_of(limit, trial));
    const T dashpot = -constant[DASHPOT] * select(holds, share.dashpot_t, T(0)) * c.turning;
    book_added(books, book, {before, trial, spring, constant[STIFFNESS], dashpot}, rate(c), dt);
    memory[0] = spring;
    action.torque += spring + dashpot;
  }

  static void resist(const double *constant, Resistance &r) {
    r.turning.stiffness += constant[STIFFNESS];
    r.turning.dashpot += constant[DASHPOT];
  }

  static double energy(const double *constant, const double *memory, double) {
    return constant[STIFFNESS] > 0 ? 0.5 * memory[0] * memory[0] / constant[STIFFNESS] : 0;
  }
};

} // namespace cdem
