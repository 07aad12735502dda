// SPDX-License-Identifier: GPL-2.0-or-later
#include "motion/guard.h"

#include "host/box_place.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "output.h"
#include "thermo.h"
#include "update.h"

#include <cmath>
#include <filesystem>
#include <unistd.h>

using namespace LAMMPS_NS;

namespace {
constexpr double LARGEST_SHARE = 0.1; // of the smallest radius, in one step
constexpr int EVERY = 100;            // steps
constexpr bigint MOST_ATOMS = 100000; // per rank; with more, no copies are kept unless rescue is given

// A value, and the rank that has it.
struct Located {
  double value;
  int rank;
};

// As LAMMPS names a restart file of a step.
std::string with_step(const std::string &file, bigint step) {
  const auto star = file.find('*');
  return star == std::string::npos ? file : file.substr(0, star) + std::to_string(step) + file.substr(star + 1);
}
} // namespace

void Guard::set_limits(double smallest_radius, double step_limit) {
  limit = step_limit;
  allowed = LARGEST_SHARE * smallest_radius;
}

void Guard::begin(double smallest_radius, double step_limit) {
  set_limits(smallest_radius, step_limit);
  if (automatic && atom->natoms > MOST_ATOMS * comm->nprocs)
    file.clear();
  if (!file.empty())
    check_folder();
  rescue.clear();
  keep();
}

// A file that could not be written would hide why the run has failed.
void Guard::check_folder() {
  int writable = 0;
  const std::string folder = std::filesystem::path(file).parent_path().string();
  if (comm->me == 0)
    writable = access(folder.empty() ? "." : folder.c_str(), W_OK) == 0;
  MPI_Bcast(&writable, 1, MPI_INT, 0, world);
  if (!writable && !automatic)
    error->all(FLERR, "Fix cdem/integrate: rescue {}: there is no folder {} that can be written", file, folder);
  if (!writable)
    file.clear();
}

bool Guard::is_due() const { return update->ntimestep % EVERY == 0; }

// Motion of the centre in a step (m); INFINITY if any number of the grain is not finite.
double Guard::moved(int i) const {
  const double *const x = atom->x[i], *const v = atom->v[i], *const f = atom->f[i];
  const double way = update->dt * std::sqrt(v[0] * v[0] + v[1] * v[1]);
  const double all = way + x[0] + x[1] + atom->omega[i][2] + f[0] + f[1] + atom->torque[i][2];
  return std::isfinite(all) ? way : INFINITY;
}

void Guard::check() {
  Located mine{0, comm->me}, worst;
  int i = -1;
  for (int k = 0; k < atom->nlocal; k++)
    if (const double way = moved(k); way > mine.value) {
      mine.value = way;
      i = k;
    }
  MPI_Allreduce(&mine, &worst, 1, MPI_DOUBLE_INT, MPI_MAXLOC, world);
  if (!suspects(worst.value))
    return;
  std::string what;
  if (worst.rank == comm->me)
    what = std::isfinite(mine.value)
               ? fmt::format("atom {} moves by {:.3g} m in one step, more than a tenth of the smallest disc's radius, "
                             "{:.3g} m: the run is unstable, or too fast for its time step",
                             atom->tag[i], mine.value, allowed)
               : fmt::format("atom {} has a position, velocity or force that is not a finite number", atom->tag[i]);
  fail(worst.rank, what);
}

bool Guard::outside(int i) const {
  constexpr int FIXED = 1;
  const Shearbox::BoxPlace place(domain, atom->x[i][0], atom->x[i][1]);
  const auto [low, high] = Shearbox::Borders::of_box(domain);
  for (int k = 0; k < 2; k++)
    if ((domain->boundary[k][0] == FIXED && place.at[k] < low[k]) ||
        (domain->boundary[k][1] == FIXED && place.at[k] >= high[k]))
      return true;
  return false;
}

void Guard::check_box() {
  constexpr int ERROR = 2; // of Thermo's IGNORE, WARN, ERROR
  if (output->thermo->lostflag != ERROR)
    return;
  Located mine{0, comm->me}, any;
  std::string what;
  for (int i = 0; i < atom->nlocal; i++)
    if (outside(i)) {
      mine.value = 1;
      what = fmt::format("atom {} has left the box, to {:.4g} {:.4g} m", atom->tag[i], atom->x[i][0], atom->x[i][1]);
    }
  MPI_Allreduce(&mine, &any, 1, MPI_DOUBLE_INT, MPI_MAXLOC, world);
  if (any.value > 0)
    fail(any.rank, what);
}

void Guard::keep() {
  check();
  if (!file.empty())
    rescue.take();
}

// `what` is the text of rank `owner`, which sends it to the others.
void Guard::fail(int owner, std::string what) {
  int size = int(what.size());
  MPI_Bcast(&size, 1, MPI_INT, owner, world);
  what.resize(size);
  MPI_Bcast(what.data(), size, MPI_CHAR, owner, world);
  std::string message = fmt::format("Fix cdem/integrate: at step {} {}. {}", update->ntimestep, what, cause());
  if (const bigint step = file.empty() ? -1 : rescue.write(file); step >= 0)
    message += fmt::format(" The state of step {} is in {}.", step, with_step(file, step));
  error->all(FLERR, message);
}

std::string Guard::cause() const {
  if (update->dt > limit)
    return fmt::format("The time step {:.4g} s is beyond the stability limit {:.4g} s of this scene: take a smaller "
                       "one, or 'dt auto'.",
                       update->dt, limit);
  return fmt::format(
      "The time step {:.4g} s is within the stability limit {:.4g} s of this scene: look for grains that "
      "overlap or are too fast at the start, for walls or forces that drive them, or for a lid that is too light.",
      update->dt, limit);
}
