// SPDX-License-Identifier: GPL-2.0-or-later
// A straight smooth wall in pieces, each a segment with rounded ends (a stadium): what a row of wall discs becomes when
// they lie infinitely close. A disc touches the wall at one point only, the one closest to it. The foot of a disc on a
// piece is the point of the piece's axis that is closest to the disc; contacts are computed as if a wall disc were
// there. As the foot follows the disc along the axis, the wall is smooth: nothing resists slip.
#pragma once

#include "kinematics.h"

#include <algorithm>
#include <cmath>

namespace cdem {

// Axis of a piece: unit vector, and half its length (m). The centre of the piece is its row.
struct WallLine {
  double ux, uy, half;
};

// Where the foot of a disc is on the axis, from the centre of the piece (m): within it, or at one of its ends.
inline double along_line(const Disc<double> &disc, const Disc<double> &centre, const WallLine &line) {
  const double along = (disc.x - centre.x) * line.ux + (disc.y - centre.y) * line.uy;
  return std::clamp(along, -line.half, line.half);
}

inline double square_distance(const Disc<double> &disc, const Disc<double> &centre, const WallLine &line) {
  const double along = along_line(disc, centre, line);
  const double dx = disc.x - centre.x - along * line.ux, dy = disc.y - centre.y - along * line.uy;
  return dx * dx + dy * dy;
}

// The row of the foot. Between the ends it keeps up with the disc along the axis. The projection is written so that it
// is exact for walls along x or y.
inline Disc<double> foot_at(double along, const Disc<double> &disc, const Disc<double> &centre, const WallLine &line) {
  Disc<double> foot = centre;
  if (std::fabs(along) == line.half) {
    foot.x += along * line.ux;
    foot.y += along * line.uy;
    return foot;
  }
  const double xx = line.ux * line.ux, xy = line.ux * line.uy, yy = line.uy * line.uy;
  auto project = [&](double Disc<double>::*x, double Disc<double>::*y) {
    foot.*x = yy * centre.*x + xx * disc.*x + xy * (disc.*y - centre.*y);
    foot.*y = xx * centre.*y + yy * disc.*y + xy * (disc.*x - centre.*x);
  };
  project(&Disc<double>::x, &Disc<double>::y);
  project(&Disc<double>::vx_half, &Disc<double>::vy_half);
  project(&Disc<double>::vx, &Disc<double>::vy);
  return foot;
}

} // namespace cdem
