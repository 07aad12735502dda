// SPDX-License-Identifier: GPL-2.0-or-later
// Adds the styles of Shearbox to those of LAMMPS in the program lmp_cdem, without the plugin loader.
#include "entry/styles.h"
#include "host/version_check.h"

#include "force.h"
#include "input.h"
#include "lammps.h"
#include "modify.h"
#include "output.h"
#include "update.h"

#include <dlfcn.h>
#include <stdexcept>
#include <string>

using namespace LAMMPS_NS;

// LAMMPS calls this after it has made its tables of styles: at the start, and again at every `clear`. The program's
// definition takes precedence over the library's, so this one is called. It adds our styles and then calls the
// library's.
void LAMMPS::post_create() {
  if (const std::string problem = Shearbox::mismatch(this); !problem.empty())
    throw std::runtime_error(problem);
  for (const Shearbox::Style &s : Shearbox::styles()) {
    if (s.pair)
      (*force->pair_map)[s.name] = s.pair;
    if (s.fix)
      (*modify->fix_map)[s.name] = s.fix;
    if (s.compute)
      (*modify->compute_map)[s.name] = s.compute;
    if (s.dump)
      (*output->dump_map)[s.name] = s.dump;
    if (s.command)
      (*input->command_map)[s.name] = s.command;
    if (s.run)
      (*update->integrate_map)[s.name] = s.run;
  }
  using PostCreate = void (*)(LAMMPS *); // how a non-virtual member function is called (Itanium C++ ABI)
  static const auto library_post_create =
      reinterpret_cast<PostCreate>(dlsym(RTLD_NEXT, "_ZN9LAMMPS_NS6LAMMPS11post_createEv"));
  if (!library_post_create)
    throw std::runtime_error("LAMMPS::post_create is not in the LAMMPS library");
  library_post_create(this);
}
