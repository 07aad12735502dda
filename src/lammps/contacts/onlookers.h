// SPDX-License-Identifier: GPL-2.0-or-later
// Who looks at single contacts: computes that list them, and computes of LAMMPS that call single().
#pragma once

namespace LAMMPS_NS {

class LAMMPS;

// Whether any compute of the deck may look at forces of single contacts: all but those that are known not to.
bool contacts_are_looked_at(LAMMPS *);

} // namespace LAMMPS_NS
