// SPDX-License-Identifier: GPL-2.0-or-later
// LAMMPS does not check whether its dumps and tables were written: on a full disk it runs on and reports success. The
// library's calls of these two functions come here first. If one of them fails, the program ends with the message of
// the system.
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <dlfcn.h>
#include <filesystem>
#include <mpi.h>
#include <string>

namespace {

using Flush = int (*)(FILE *);

int checked(const char *function, FILE *file) {
  const auto libc = reinterpret_cast<Flush>(dlsym(RTLD_NEXT, function));
  const bool output = file && file != stdout && file != stderr;
  const int descriptor = output ? fileno(file) : -1;
  std::error_code unknown;
  const auto name = std::filesystem::read_symlink("/proc/self/fd/" + std::to_string(descriptor), unknown);
  const int status = libc(file);
  if (status == 0 || !output)
    return status;
  std::fprintf(stderr, "ERROR: cannot write %s: %s\n", name.c_str(), std::strerror(errno));
  MPI_Abort(MPI_COMM_WORLD, 1);
  return status;
}

} // namespace

extern "C" int fflush(FILE *file) { return checked("fflush", file); }
extern "C" int fclose(FILE *file) { return checked("fclose", file); }
