// SPDX-License-Identifier: GPL-2.0-or-later
// fix ID group cdem/shape [folder DIR] type T TEMPLATE [type T TEMPLATE ...] [density RHO] [orient SEED]
//
// Grains of several rigid discs (CDEM). One atom is one grain. Its radius is the circumscribed one, to which the
// template of its type is scaled, so one template serves a distribution of sizes.
//
//   TEMPLATE  single               a disc
//             triple               three equal discs, each touching the other two
//             discs N x y r ...    N discs, at most 1000, in any unit, about any origin. They may overlap and must be
//                                  connected; none may lie inside another or nearly coincide with it: the distance of
//                                  the centres and the difference of the radii must add up to 2 % of the smaller one
//             file NAME            the same from a file with a line "x y r" per disc; # starts a comment
//             line UX UY           not a grain: a piece of a straight, smooth wall along the vector (UX, UY)
//   folder    where the files of the templates that follow are (default: the current folder)
//   density   mass per area RHO > 0 (kg/m^2): sets the masses of the group's grains, from the area of the union of the
//             discs, when the fix is made, at the start of each run, and of grains that arrive in a run as they arrive.
//             Default: masses are left as they are, as cdem/create, a restart file or "set mass" gave them. Refused
//             when a run begins are those of "set density/disc", which gives a clump the mass of the circle around it:
//             they are recognized by another type, with another share of its circle, that has the same mass per circle
//   orient    a grain of the group that is new in a run is turned to a random angle, once; SEED >= 1. The angle
//             depends only on SEED and the atom id. Default: angle 0
//
// An atom of radius R with the template line is a wall R thick and R long, with rounded ends in addition. Pieces that
// meet, such as atoms R apart in a row along (UX, UY), are one wall; it may turn a corner where pieces of two types
// meet, and the forces on a rounded outer corner are those of the piece with the lower id. A disc touches a wall at the
// point that is closest, as it would touch a wall disc of radius R/2 there, but without friction: phi and rolling must
// be 0 for contacts of these types. Such an atom is always a wall, never a grain of fix cdem/integrate. Where ends that
// met part, as walls move, both bear a disc that is over the gap, from one step to the next, and one where they meet
// again: the forces jump.
//
// displace_atoms rotate turns the places of grains about a point, and leaves the angle of each as it is. Walls of
// several discs or of lines do not turn: with a spin, as fix move rotate gives it, they are refused.
//
// Every atom type needs one template. Centre of mass, area and inertia are those of the union of the discs, see
// core/grain_shape.h. At most one fix of this style may exist. Without it, all atoms are single discs.
//
// Global array: one row per atom type, with columns (no unit)
//
//   1  number of discs of a grain
//   2  circumscribed diameter over the diameter of the largest disc
//   3  area over that of the circumscribed circle
//
// For example:  fix shape all cdem/shape type 1 triple type 2 single
//               variable size equal f_shape[1][2]     # 1+2/sqrt(3)
#pragma once

#include "core/grain_shape.h"
#include "host/deck_words.h"
#include "host/glides.h"

#include "fix.h"

#include <optional>
#include <string>
#include <vector>

namespace LAMMPS_NS {

class FixCDEMShape : public Fix, public Glides {
public:
  // The fix of this style, or null.
  static FixCDEMShape *find(LAMMPS *);
  // The shape of an atom type: a single disc where there is no such fix.
  static const cdem::GrainShape &shape(LAMMPS *, int type);

  FixCDEMShape(LAMMPS *, int, char **);
  ~FixCDEMShape() override;

  int setmask() override;
  void init() override;
  double compute_array(int, int) override;
  void set_arrays(int) override;

  // Sets the masses of the group's grains, where there is a density: before anybody looks at them as a run is prepared.
  void set_masses() const;
  // The angle of a grain that is new (rad).
  double first_angle(int i) const;

private:
  void read_template(Shearbox::DeckWords &);
  cdem::GrainShape read_line(Shearbox::DeckWords &) const;
  std::vector<cdem::GrainShape::Member> read_discs(Shearbox::DeckWords &) const;
  std::vector<cdem::GrainShape::Member> read_file(const std::string &name) const;
  void refuse_masses_of_circles() const;
  double share(int type) const; // of the circle that the discs fill
  void set_mass(int i) const;

  std::string folder;                                  // of template files
  std::vector<std::optional<cdem::GrainShape>> shapes; // by type
  double density = 0;                                  // 0: leave the masses alone
  int seed = 0;                                        // 0: leave the angles alone
};

} // namespace LAMMPS_NS
