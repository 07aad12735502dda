// SPDX-License-Identifier: GPL-2.0-or-later
// Which of the contact laws of laws.h is in use: what a loop over pairs is compiled for.
#pragma once

namespace cdem {

struct ContactRules {
  int accumulation = 0;   // index in Accumulations, see laws.h
  unsigned additions = 0; // bit k: whether the k-th of Additions is in use, see laws.h
  bool limit_damping = false;
  bool books = false; // whether energy losses are summed, for an energy audit
};

// The most numbers per pair that a law may have, in addition to the tangential spring and PairConstants.
constexpr int MOST_NUMBERS = 8;

// Letters of the name of a number that contacts remember. Both are part of what restart files hold.
constexpr int LONGEST_NAME = 15;

} // namespace cdem
