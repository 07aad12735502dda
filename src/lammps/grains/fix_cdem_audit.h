// SPDX-License-Identifier: GPL-2.0-or-later
// fix cdem/audit: made by compute cdem/energy with `audit yes`, not by the user. Holds the books of all energy that
// comes and goes; they are in restart files. Whoever does work or loses energy writes it down: the pair style friction
// and dashpots, fix cdem/integrate the drag, fixes cdem/lid and cdem/move the work of their walls.
#pragma once

#include "host/glides.h"

#include "fix.h"

namespace LAMMPS_NS {

class FixCDEMAudit : public Fix, public Glides {
public:
  // Who knows all energy there is, and opens the books as the first run begins.
  class Opener {
  public:
    virtual ~Opener() = default;
    virtual void open_books() = 0; // unless they are open
  };

  static constexpr const char *ID = "CDEM_AUDIT";

  // J, this rank's share since the books were opened. The work of walls is that on the grains.
  struct Books {
    double friction = 0, dashpots = 0, drag = 0, walls = 0;
  };
  // What was there when the books were opened (J): of the grains and springs, and sum of m g x. Of all ranks.
  struct Opening {
    double energy = 0, gravity = 0;
  };

  // The fix of this style, or null: then nobody keeps books.
  static FixCDEMAudit *find(LAMMPS *);

  FixCDEMAudit(LAMMPS *, int, char **);

  int setmask() override { return 0; }
  void setup(int) override;
  void write_restart(FILE *) override;
  void restart(char *) override;

  Books all() const; // of all ranks

  Opener *opener = nullptr;
  Books books;
  Opening opening;
  bool open = false;
};

} // namespace LAMMPS_NS
