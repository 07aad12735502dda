// SPDX-License-Identifier: GPL-2.0-or-later
// The program lmp_cdem: LAMMPS with its own command line, and with the styles of Shearbox known from the start (see
// own_styles.cpp).
#include "host/version_check.h"

#include "comm.h"
#include "error.h"
#include "exceptions.h"
#include "force.h"
#include "input.h"
#include "lammps.h"
#include "utils.h"
#include "variable.h"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <mpi.h>
#include <string>

using namespace LAMMPS_NS;

// The word after -in, empty if there is none: LAMMPS then reads from its standard input.
static std::string input_file(int argc, char **argv) {
  for (int i = argc - 2; i >= 1; i--)
    if (const std::string word = argv[i]; word == "-in" || word == "-i")
      return argv[i + 1];
  return "";
}

// LAMMPS itself finds out on its first rank only, and in 4Feb2025 the others then wait for it for ever.
static bool can_be_read(const std::string &file) {
  int rank, status = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank == 0 && !file.empty() && file != "none" && !std::ifstream(file)) {
    status = errno;
    std::fprintf(stderr, "ERROR: Cannot open input script %s: %s\n", file.c_str(), std::strerror(status));
  }
  MPI_Bcast(&status, 1, MPI_INT, 0, MPI_COMM_WORLD);
  return status == 0;
}

// Sets the variable `decks` to the folder of the input file, unless -var gives it: a deck includes other files from
// there, while LAMMPS itself looks for them in the current folder only. LAMMPS cannot include from a path with a blank
// in it; the path relative to the current folder often has none.
static void set_decks(LAMMPS *lmp, const std::string &file) {
  if (file.empty())
    return;
  std::string folder = std::filesystem::path(file).parent_path().string();
  if (folder.find(' ') != std::string::npos)
    folder = std::filesystem::proximate(folder).string();
  if (folder.find(' ') != std::string::npos)
    lmp->error->warning(FLERR, "LAMMPS's include cannot read from folder '{}': there is a blank in its name", folder);
  lmp->input->variable->set("decks index \"" + (folder.empty() ? "." : folder) + "\"");
}

static void check_styles(LAMMPS *lmp) {
  if (!lmp->force->pair_map->count("cdem"))
    lmp->error->all(FLERR, "The styles of Shearbox are not there: this LAMMPS library calls its own "
                           "LAMMPS::post_create, not that of lmp_cdem. Build LAMMPS without -Bsymbolic, "
                           "-Bsymbolic-functions and -fno-semantic-interposition (also part of -Ofast); or with the "
                           "package PLUGIN, and load cdemplugin.so");
}

int main(int argc, char **argv) {
  MPI_Init(&argc, &argv);
  const std::string deck = input_file(argc, argv);
  if (!can_be_read(deck)) {
    MPI_Finalize();
    return EXIT_FAILURE;
  }
  try {
    auto *lmp = new LAMMPS(argc, argv, MPI_COMM_WORLD);
    check_styles(lmp);
    if (lmp->comm->me == 0)
      utils::logmesg(lmp, "Shearbox " + Shearbox::version() + "\n");
    set_decks(lmp, deck);
    lmp->input->file();
    delete lmp;
  } catch (const LAMMPSAbortException &) { // one rank failed, the others may wait for it
    MPI_Abort(MPI_COMM_WORLD, EXIT_FAILURE);
  } catch (const LAMMPSException &) { // all ranks failed together, the message is printed already
    MPI_Finalize();
    return EXIT_FAILURE;
  } catch (const std::exception &e) {
    std::fprintf(stderr, "ERROR: %s\n", e.what());
    MPI_Abort(MPI_COMM_WORLD, EXIT_FAILURE);
  }
  MPI_Finalize();
}
