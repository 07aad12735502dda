// SPDX-License-Identifier: GPL-2.0-or-later
// dump ID group cdem/local N file c_ID[*] ...
//
// The dump local of LAMMPS, of which other programs know what the columns are: those of computes cdem/contacts,
// cdem/discs and cdem/grid have the names of their fields (c_contacts[7] is fn), unless several columns would have the
// same one; and rows have no blank at their end, which programs that split them at blanks take for an empty column. All
// else, and all of dump_modify, is as for dump local.
//
// For example:  compute contacts all cdem/contacts id1 id2 x y fn ft
//               dump contacts all cdem/local 1000 contacts.dump c_contacts[*]
//               dump_modify contacts format float %.9g
//
// writes rows under ITEM: ENTRIES id1 id2 x y fn ft.
#pragma once

#include "dump_local.h"

#include <string>

namespace LAMMPS_NS {

class DumpCDEMLocal : public DumpLocal {
public:
  using DumpLocal::DumpLocal;

protected:
  void init_style() override;

private:
  std::string words, names; // of the columns: as LAMMPS has them, and what this has put in their place
};

} // namespace LAMMPS_NS
