// SPDX-License-Identifier: GPL-2.0-or-later
// fix cdem/audit: made by compute cdem/energy with `audit yes`, not by the user. Has the books: the sums of all work
// and energy losses, which are also in restart files. Each part of the program adds its own: the pair style those of
// friction and dashpots, fix cdem/integrate that of drag, fixes cdem/lid and cdem/move the work of their walls.
#pragma once

#include "host/glides.h"

#include "fix.h"

namespace LAMMPS_NS {

class FixCDEMAudit : public Fix, public Glides {
public:
  // Computes the energy of all grains and springs, and opens the books at the start of the first run. Has the contacts
  // add their losses to the books.
  class Opener {
  public:
    virtual void open_books() = 0; // does nothing if they are open
    virtual void take_gravity() = 0;
    virtual void book_losses() = 0;

  protected:
    ~Opener() = default;
  };

  static constexpr const char *ID = "CDEM_AUDIT";

  // Sums since the books were opened, this rank's part (J). `walls` is the work of the walls on the grains.
  struct Books {
    double friction = 0, dashpots = 0, drag = 0, walls = 0;
  };
  // Over all ranks: energy of the grains and springs when the books were opened (J); gravity (m/s^2), and the sum of
  // m g.x that its work is counted from (J).
  struct Opening {
    double energy = 0, gx = 0, gy = 0, gravity = 0;
  };

  // The fix of this style, or null if there is no audit.
  static FixCDEMAudit *find(LAMMPS *);

  FixCDEMAudit(LAMMPS *, int, char **);

  int setmask() override { return 0; }
  void setup(int) override;
  void write_restart(FILE *) override;
  void restart(char *) override;

  Books all() const;   // of all ranks
  void take_gravity(); // to be called when gravity may have changed: its work is counted from then on

  Opener *opener = nullptr;
  Books books;
  Opening opening;
  bool open = false;
};

} // namespace LAMMPS_NS
