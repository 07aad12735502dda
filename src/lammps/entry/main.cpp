// SPDX-License-Identifier: GPL-2.0-or-later
// The program lmp_cdem: LAMMPS with its own command line, and the styles of Shearbox there from the start.
#include "entry/styles.h"
#include "host/version_check.h"

#include "comm.h"
#include "error.h"
#include "exceptions.h"
#include "force.h"
#include "input.h"
#include "lammps.h"
#include "modify.h"
#include "update.h"
#include "utils.h"
#include "variable.h"

#include <cstdio>
#include <cstdlib>
#include <dlfcn.h>
#include <filesystem>
#include <mpi.h>
#include <stdexcept>
#include <string>

using namespace LAMMPS_NS;

// LAMMPS calls this after it has made its tables of styles: at the start, and again at every `clear`. The program's
// definition comes before the library's, so we are called, add our styles, and hand on to the library's.
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

// The folder of the input file as variable `decks`, unless -var gives it: a deck includes its parts from there, and
// LAMMPS itself looks for them in the current folder only. It takes no blanks in what it includes; as seen from the
// current folder there often are none.
static void set_decks(LAMMPS *lmp, int argc, char **argv) {
  for (int i = 1; i + 1 < argc; i++) {
    const std::string word = argv[i];
    if (word != "-in" && word != "-i")
      continue;
    std::string folder = std::filesystem::path(argv[i + 1]).parent_path().string();
    if (folder.find(' ') != std::string::npos)
      folder = std::filesystem::proximate(folder).string();
    if (folder.find(' ') != std::string::npos)
      lmp->error->warning(FLERR, "LAMMPS's include cannot read from folder '{}': there is a blank in its name", folder);
    lmp->input->variable->set("decks index \"" + (folder.empty() ? "." : folder) + "\"");
  }
}

int main(int argc, char **argv) {
  MPI_Init(&argc, &argv);
  try {
    auto *lmp = new LAMMPS(argc, argv, MPI_COMM_WORLD);
    if (lmp->comm->me == 0)
      utils::logmesg(lmp, "Shearbox " + Shearbox::version() + "\n");
    set_decks(lmp, argc, argv);
    lmp->input->file();
    delete lmp;
  } catch (const LAMMPSAbortException &e) { // one rank failed, the others may wait for it
    MPI_Abort(e.universe, EXIT_FAILURE);
  } catch (const LAMMPSException &) { // all ranks failed together, the message is out
    MPI_Finalize();
    return EXIT_FAILURE;
  } catch (const std::exception &e) {
    std::fprintf(stderr, "ERROR: %s\n", e.what());
    MPI_Abort(MPI_COMM_WORLD, EXIT_FAILURE);
  }
  MPI_Finalize();
}
