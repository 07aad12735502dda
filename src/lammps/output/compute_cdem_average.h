// SPDX-License-Identifier: GPL-2.0-or-later
// compute ID group cdem/average [within XLO XHI YLO YHI] [field ...]
//
// Mean stress, strain rate and fabric of the grains of the group inside a rectangle, at the end of the step.
//
//   within  sides of the rectangle (m): numbers, EDGE (of the box) or v_NAME, an equal-style variable, so that it can
//           follow a lid or a moved wall. Default: the whole box. Over a periodic side it may be as long as the period
//
// Global vector: one value per field, in the order given; by default all of these:
//
//   solid         solid fraction: area of the grains over that of the rectangle (no unit)
//   grains        number of grains
//   mass          mean mass of a grain (kg)
//   coordination  mean number of contacts of a grain, with grains and walls, that are closed
//   stress_..     xx yy xy yx: stress of the contacts (N/m; over the thickness: Pa)
//   kinetic_..    xx yy xy: stress of the motion about the mean velocity (N/m)
//   velocity_..   x y: mean velocity, by mass (m/s)
//   spin          mean angular velocity of a grain (rad/s)
//   gradient_..   xx yy xy yx: velocity gradient (1/s); xy is d velocity_x/dy. 0 if the grains lie in a line
//   fabric_..     xx yy xy: fabric tensor <n n> of the contacts, n their normals. Trace 1
//   normal_..     xx yy xy: <fn n n>/<fn> of the normal forces. Trace 1
//   tangential_.. xx yy xy: <ft (t n + n t)/2>/<fn> of the tangential forces. Trace 0
//
// Of stresses, pressure is positive, as in compute pressure; xy is the force in y on a plane with its normal in x. yx
// is the same for grains whose spin is steady. Where there is no grain or no contact, means over them are 0.
//
// A grain counts with the share of its area that lies in the rectangle: exactly, of the union of its discs. Where two
// grains overlap, the area counts twice. A contact belongs to its grains one by one: for each that is in the group the
// line from its centre to the contact counts, with the share of its length that lies in the rectangle. So with the
// group of the grains, walls are the border of the stress; stress times area, summed over the parts of a rectangle, is
// that of the whole; and of grains at rest it is the sum of x f over the forces f on the walls at x. Formulas and
// sources: core/field_sums.h. Pieces of smooth walls (template line of fix cdem/shape) never count.
//
// From these: anisotropy of contacts a_c = 2 sqrt((fabric_xx - fabric_yy)^2 + 4 fabric_xy^2) (Rothenburg and Bathurst
// 1989), and in the same way that of the force tensors, which includes a_c; inertial number I = |gradient_xy +
// gradient_yx| sqrt(mass/p), p = (stress_xx + stress_yy)/2 (da Cruz et al. 2005).
//
// For example:  variable top equal bound(lid,ymin)-0.5*v_d
//               compute inside grains cdem/average within 0 0.1 0 v_top coordination solid stress_yy stress_xy
//               thermo_style custom step c_inside[*]
//
// The same bits for any number of ranks. It costs nothing between the steps for which it is asked, and then about as
// much as ten steps. Needs pair_style cdem.
#pragma once

#include "output/cell_fields.h"

#include "compute.h"

#include <vector>

namespace LAMMPS_NS {

class ComputeCDEMAverage : public Compute {
public:
  ComputeCDEMAverage(LAMMPS *, int, char **);

  void init() override;
  void compute_vector() override;

private:
  CellFields fields;
  std::vector<double> values;
};

} // namespace LAMMPS_NS
