// SPDX-License-Identifier: GPL-2.0-or-later
// Cohesion by a constant pull-off force: discs that touch attract each other with F_c (Gilabert, Roux & Castellanos
// 2007, whose attraction reaches no further here than the contact itself).
//
//   f_n = k_n overlap - F_c
//
// A contact without load therefore has the overlap F_c/k_n. When pulled, its tension grows in proportion to the
// opening, and it breaks at F_c, its tensile limit. It forms anew whenever the discs touch. Friction is limited by e_n
// = k_n overlap, the repulsive part alone. The force has the potential -F_c overlap. To break a contact without load
// takes the energy F_c^2/(2 k_n), which is stored, not lost.
#pragma once

#include "core/contact_law.h"

namespace cdem {

struct Cohesion {
  static constexpr const char *NAME = "cohesion";
  static constexpr std::array<Parameter, 1> PARAMETERS{{{"F_c", "N"}}};
  static constexpr std::array<Remembered, 0> REMEMBERS{};
  static constexpr int BOOKS = 0;
  static constexpr int CONSTANTS = 1; // of a pair

  static void set_constants(const double *parameter, const Material &, const TwoGrains &, double *constant) {
    constant[0] = parameter[0];
  }

  // Weighted like a dashpot: it acts for the part of the step in which the discs touched.
  template <class T, class Share, class Books>
  [[gnu::always_inline]] static void act(const Contact<T> &, const Share &share, const NormalSpring<T> &,
                                         const T *constant, T *, double, Action<T> &action, Books &, std::size_t) {
    action.fn -= constant[0] * share.dashpot_t;
  }

  static void resist(const double *, Resistance &) {}

  static double energy(const double *constant, const double *, double overlap) { return -constant[0] * overlap; }
};

} // namespace cdem
