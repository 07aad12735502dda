# SPDX-License-Identifier: GPL-2.0-or-later
"""The recipe for Spack, which builds branch main of the clone that it is in."""

from pathlib import Path

from spack_repo.builtin.build_systems.cmake import CMakePackage

from spack.package import *

# What Spack installs of LAMMPS has only some of its headers: these are in the archive that its own recipe takes.
ARCHIVES = {
    "20210929.3": ("stable_29Sep2021_update3", "e4c274f0dc5fdedc43f2b365156653d1105197a116ff2bafe893523cdb22532e"),
    "20250204": ("patch_4Feb2025", "a4cb0a58451d47ac31ee3e1f148d92f445298d6e27f2d06f161b9b4168d79eb1"),
}


class Shearbox(CMakePackage):
    """The direct shear test of sand, in two dimensions, by the distinct element method in LAMMPS."""

    git = Path(__file__).resolve().parents[5].as_uri()
    version("main", branch="main")
    license("GPL-2.0-or-later")

    depends_on("cxx", type="build")
    depends_on("cmake@3.22:", type="build")
    depends_on("mpi")
    depends_on(f"lammps@{','.join(ARCHIVES)}+lib+mpi")
    for lammps, (tag, sha256) in ARCHIVES.items():
        resource(
            name="lammps-headers",
            url=f"https://github.com/lammps/lammps/archive/{tag}.tar.gz",
            sha256=sha256,
            placement={"src": "lammps-headers"},
            when=f"^lammps@{lammps}",
        )
    depends_on("python@3.11:", type=("build", "run"))
    for module in ("numpy", "scipy", "matplotlib", "jinja2", "pillow", "rich"):
        depends_on(f"py-{module}", type="run")

    def cmake_args(self):
        """As README says for a LAMMPS of one's own."""
        return [
            self.define("SHEARBOX_TESTS", False),
            self.define("LAMMPS_HEADERS", join_path(self.stage.source_path, "lammps-headers")),
            self.define("LAMMPS_LIBRARY", self.spec["lammps"].libs[0]),
        ]

    @run_after("install")
    def name_python(self):
        """The command names Debian's, which has not the modules of Spack."""
        command = join_path(self.prefix, "share", "shearbox", "tools", "shearbox")
        filter_file("^#!.*", f"#!{self.spec['python'].command.path}", command)

    def setup_run_environment(self, env):
        """For scripts that import shearbox."""
        env.prepend_path("PYTHONPATH", join_path(self.prefix, "share", "shearbox", "tools"))
