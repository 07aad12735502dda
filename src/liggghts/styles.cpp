// SPDX-License-Identifier: GPL-2.0-or-later
// All styles, and the moment when LIGGGHTS learns of them: the contact models when the library is loaded, the others
// when a deck takes one of the models.
#include "liggghts/styles.h"

#include "liggghts/accumulation.h"
#include "liggghts/create.h"
#include "liggghts/fix_integrate.h"
#include "liggghts/fix_lid.h"
#include "liggghts/fix_move.h"

namespace Liggghts {

namespace {

template <class Style> Fix *fix(LAMMPS *lmp, int narg, char **arg) { return new Style(lmp, narg, arg); }

[[maybe_unused]] const bool registered = (Accumulation::register_models(), true);

} // namespace

void add_styles(LAMMPS *lmp) {
  auto &fixes = fix_styles(lmp);
  fixes["cdem/integrate"] = fix<FixIntegrate>;
  fixes["cdem/lid"] = fix<FixLid>;
  fixes["cdem/move"] = fix<FixMove>;
  commands(lmp)["cdem/create"] = create;
}

} // namespace Liggghts
