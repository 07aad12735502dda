// SPDX-License-Identifier: GPL-2.0-or-later
// The program lmp_cdem: LAMMPS with its own command line, and with the styles of Shearbox known from the start (see
// own_styles.cpp).
#include "host/version_check.h"

#include "comm.h"
#include "error.h"
#include "exceptions.h"
#include "input.h"
#include "lammps.h"
#include "utils.h"
#include "variable.h"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <mpi.h>
#include <string>

using namespace LAMMPS_NS;

// Sets the variable `decks` to the folder of the input file, unless -var gives it: a deck includes other files from
// there, while LAMMPS itself looks for them in the current folder only. LAMMPS cannot include from a path with a blank
// in it; the path relative to the current folder often has none.
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
  } catch (const LAMMPSException &) { // all ranks failed together, the message is printed already
    MPI_Finalize();
    return EXIT_FAILURE;
  } catch (const std::exception &e) {
    std::fprintf(stderr, "ERROR: %s\n", e.what());
    MPI_Abort(MPI_COMM_WORLD, EXIT_FAILURE);
  }
  MPI_Finalize();
}
