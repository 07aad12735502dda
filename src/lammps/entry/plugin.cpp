// SPDX-License-Identifier: GPL-2.0-or-later
// cdemplugin.so: checks the LAMMPS that loads it, then takes the styles from cdemstyles.so in the same folder.
#include "entry/styles.h"
#include "host/version_check.h"

#include "lammps.h"
#include "lammpsplugin.h"
#include "library.h"
#include "output.h"
#include "version.h"

#include <cstdio>
#include <dlfcn.h>
#include <string>

namespace {

// Only one rank prints. The run fails later, when the input file asks for a style that is not there.
void refuse(void *lmp, const std::string &why) {
  if (lammps_extract_setting(lmp, "world_rank") == 0)
    std::fprintf(stderr, "ERROR: plugin refused: %s\n", why.c_str());
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
  const auto styles = reinterpret_cast<decltype(&shearbox_styles)>(dlsym(file, "shearbox_styles"));
  if (!styles)
    return refuse(lmp, dlerror());

  static const std::string info = "Shearbox " + Shearbox::version();
  for (const Shearbox::Style &s : *styles()) {
    if (s.dump) { // the loader has no dump styles
      (*static_cast<LAMMPS_NS::LAMMPS *>(lmp)->output->dump_map)[s.name] = s.dump;
      continue;
    }
    lammpsplugin_t plugin{};
    plugin.version = LAMMPS_VERSION;
    plugin.style = s.kind;
    plugin.name = s.name;
    plugin.info = info.c_str();
    plugin.author = "the Shearbox authors";
    plugin.handle = handle;
    if (s.pair)
      plugin.creator.v1 = reinterpret_cast<lammpsplugin_factory1 *>(s.pair);
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
