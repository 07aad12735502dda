// SPDX-License-Identifier: GPL-2.0-or-later
// Which of the contact laws of laws.h is in use: what a loop over pairs is compiled for.
#pragma once

namespace cdem {

struct ContactRules {
  int accumulation = 0;   // place in the list of laws.h
  unsigned additions = 0; // bit k: the k-th of the list there
  bool limit_damping = false;
  bool books = false; // of losses
};

// More numbers of a pair than any law has, beside the tangential spring and PairConstants.
constexpr int MOST_NUMBERS = 8;

} // namespace cdem
