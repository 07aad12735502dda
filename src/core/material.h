// SPDX-License-Identifier: GPL-2.0-or-later
// The constants of springs, dashpots and friction.
#pragma once

#include <cmath>

namespace cdem {

// Constants of the contacts between two atom types.
struct Material {
  double kn = 0, ks = 0; // N/m
  double dn = 0, ds = 0; // dashpots over 2 sqrt(m): h sqrt(k)
  double mu = 0;         // tan(phi)
};

inline Material material(double kn, double ks, double hn, double hs, double mu) {
  return {kn, ks, hn * std::sqrt(kn), hs * std::sqrt(ks), mu};
}

} // namespace cdem
