// SPDX-License-Identifier: GPL-2.0-or-later
#include "styles.h"

#include "lammpsplugin.h"
#include "version.h"

#include <cstdio>
#include <string>

// Called by `plugin load cdemplugin.so`.
extern "C" void lammpsplugin_init(void *lmp, void *handle, void *regfunc) {
  if (const char *problem = Shearbox::mismatch(static_cast<LAMMPS_NS::LAMMPS *>(lmp))) {
    std::fprintf(stderr, "ERROR: plugin refused: %s\n", problem);
    return;
  }
  static const std::string info = std::string("Shearbox ") + Shearbox::version();
  for (const Shearbox::Style &s : Shearbox::styles()) {
    lammpsplugin_t plugin{};
    plugin.version = LAMMPS_VERSION;
    plugin.style = s.kind;
    plugin.name = s.name;
    plugin.info = info.c_str();
    plugin.author = "the Shearbox authors";
    plugin.handle = handle;
    if (s.pair) plugin.creator.v1 = reinterpret_cast<lammpsplugin_factory1 *>(s.pair);
    if (s.command) plugin.creator.v1 = reinterpret_cast<lammpsplugin_factory1 *>(s.command);
    if (s.fix) plugin.creator.v2 = reinterpret_cast<lammpsplugin_factory2 *>(s.fix);
    if (s.compute) plugin.creator.v2 = reinterpret_cast<lammpsplugin_factory2 *>(s.compute);
    reinterpret_cast<lammpsplugin_regfunc>(regfunc)(&plugin, lmp);
  }
}
