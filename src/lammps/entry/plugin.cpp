// SPDX-License-Identifier: GPL-2.0-or-later
// cdemplugin.so: checks the LAMMPS that loads it, then takes the styles from cdemstyles.so in the same folder.
#include "entry/styles.h"
#include "host/compat.h"
#include "host/version_check.h"

#include "lammps.h"
#include "lammpsplugin.h"
#include "library.h"
#include "output.h"
#include "update.h"
#include "version.h"

#include <algorithm>
#include <cstdio>
#include <dlfcn.h>
#include <string>
#include <vector>

namespace {

// Only one rank prints. The run fails later, when the input file asks for a style that is not there.
void refuse(void *lmp, const std::string &why) {
  if (lammps_extract_setting(lmp, "world_rank") == 0)
    std::fprintf(stderr, "ERROR: plugin refused: %s\n", why.c_str());
}

const std::vector<Shearbox::Style> *styles;

// LAMMPS's loader has no dump styles, and in older versions no run styles: they go straight into LAMMPS's tables.
bool loader_has(const Shearbox::Style &s) { return !s.dump && (!s.run || Shearbox::LOADER_HAS_RUN_STYLES); }
void add_what_the_loader_has_not(LAMMPS_NS::LAMMPS *lmp) {
  for (const Shearbox::Style &s : *styles) {
    if (s.dump)
      (*lmp->output->dump_map)[s.name] = s.dump;
    if (s.run && !loader_has(s))
      (*lmp->update->integrate_map)[s.name] = s.run;
  }
}

// After `clear`, and in a second LAMMPS of the same process, newer loaders restore what they have, without asking us. A
// pair style comes before all other styles.
LAMMPS_NS::Pair *create_pair(LAMMPS_NS::LAMMPS *lmp) {
  add_what_the_loader_has_not(lmp);
  return std::find_if(styles->begin(), styles->end(), [](const auto &s) { return s.pair; })->pair(lmp);
}

std::string file_beside_this(const char *name) {
  Dl_info info{};
  dladdr(reinterpret_cast<void *>(&file_beside_this), &info);
  const std::string path = info.dli_fname;
  return path.substr(0, path.rfind('/') + 1) + name;
}

} // namespace

// Called by `plugin load cdemplugin.so`.
extern "C" void lammpsplugin_init(void *lmp, void *handle, void *regfunc) {
  if (const std::string problem = Shearbox::mismatch(lmp); !problem.empty())
    return refuse(lmp, problem);

  void *file = dlopen(file_beside_this("cdemstyles.so").c_str(), RTLD_NOW);
  if (!file)
    return refuse(lmp, dlerror());
  const auto all_styles = reinterpret_cast<decltype(&shearbox_styles)>(dlsym(file, "shearbox_styles"));
  if (!all_styles)
    return refuse(lmp, dlerror());
  styles = all_styles();
  add_what_the_loader_has_not(static_cast<LAMMPS_NS::LAMMPS *>(lmp));

  static const std::string info = "Shearbox " + Shearbox::version();
  for (const Shearbox::Style &s : *styles) {
    if (!loader_has(s))
      continue;
    lammpsplugin_t plugin{};
    plugin.version = LAMMPS_VERSION;
    plugin.style = s.kind;
    plugin.name = s.name;
    plugin.info = info.c_str();
    plugin.author = "the Shearbox authors";
    plugin.handle = handle;
    if (s.pair)
      plugin.creator.v1 = reinterpret_cast<lammpsplugin_factory1 *>(create_pair);
    if (s.command)
      plugin.creator.v1 = reinterpret_cast<lammpsplugin_factory1 *>(s.command);
    if (s.fix)
      plugin.creator.v2 = reinterpret_cast<lammpsplugin_factory2 *>(s.fix);
    if (s.run)
      plugin.creator.v2 = reinterpret_cast<lammpsplugin_factory2 *>(s.run);
    if (s.compute)
      plugin.creator.v2 = reinterpret_cast<lammpsplugin_factory2 *>(s.compute);
    reinterpret_cast<lammpsplugin_regfunc>(regfunc)(&plugin, lmp);
  }
}
