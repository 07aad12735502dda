// SPDX-License-Identifier: GPL-2.0-or-later
// What fixes cdem/lid and cdem/move share: a rigid set of wall discs that moves in translation, without rotation. Its
// discs must not be in the group of fix cdem/integrate.
#pragma once

#include "liggghts/host.h"

namespace Liggghts {

class FixIntegrate;

class WallBody : public Fix {
public:
  WallBody(LAMMPS *, int narg, char **arg);

  int setmask() override;
  void init() override;

protected:
  struct Vector {
    double x, y;
  };

  Words words_of(int narg, char **arg) const;
  bool in_group(int i) const;
  Vector force() const; // of the contacts on the body, all ranks together (N)
  double total_mass() const;
  int count() const;
  void shift(Vector displacement, Vector velocity) const;
  // Velocity (m/s) and the acceleration with which contacts carry it forward (m/s^2).
  void set_motion(Vector velocity, Vector acceleration) const;

private:
  template <class Term> double sum(Term) const;

  FixIntegrate *motion = nullptr;
};

} // namespace Liggghts
