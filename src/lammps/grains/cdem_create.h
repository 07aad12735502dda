// SPDX-License-Identifier: GPL-2.0-or-later
// cdem/create TYPE row X1 Y1 X2 Y2 N diameter D density RHO
// cdem/create TYPE fill N region XLO XHI YLO YHI diameter DMIN DMAX power P density RHO seed S
//
// Makes discs of mass RHO pi D^2/4, or grains of the shape that fix cdem/shape gives to TYPE, with circumscribed
// diameter D and the mass of that shape. RHO is an areal density, density x thickness (kg/m^2), lengths are in m.
//
//   row   N discs, their centres evenly spaced from (X1, Y1) to (X2, Y2), both included. Pieces of a smooth wall
//         (template line of fix cdem/shape) along their axis must be D/2 apart, as long as they are: not less, and a
//         warning tells of gaps
//   fill  N grains without overlap inside a rectangle, as a loose column for packing. Diameters follow the number
//         density n(d) ~ d^P from DMIN to DMAX: the law is divided into N equal shares, and each gives one grain. The
//         seed S >= 1 decides their order. They stand in rows with random gaps, spread over the whole height (see
//         core/fill.h)
//
// N >= 1; D, DMIN, DMAX, RHO > 0. Needs a box, dimension 2, atom_style sphere and atom ids. Errors: a centre outside of
// the box, grains that do not fit into the rectangle.
//
// Atom ids continue after the largest one, in the order of creation. Positions and ids are the same for any number of
// ranks.
#pragma once

#include "core/create_words.h"
#include "host/deck_words.h"

#include "command.h"

#include <vector>

namespace LAMMPS_NS {

class CDEMCreate : public Command {
public:
  explicit CDEMCreate(LAMMPS *);
  void command(int, char **) override;

private:
  using Disc = cdem::PlacedDisc;
  using Words = Shearbox::DeckWords;

  cdem::Creation fill(Words &) const;
  void check(const Disc &) const;
  void check_joints(const std::vector<Disc> &row) const;
  bool is_mine(const Disc &) const;
  void create(const std::vector<Disc> &, double density);

  int type = 0;
};

} // namespace LAMMPS_NS
