#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Kratos 10.4.4 (KratosDEMApplication): coefficient of restitution of two discs.
#
# Guess: two grains that meet head-on part with COEFFICIENT_OF_RESTITUTION times the speed they came with, whatever the law, to the
#        2 % that the time step costs.
# Seen:  so it is for spheres, and for discs with the linear law. Discs with DEM_D_Hertz_viscous_Coulomb2D part with 0.22 where 0.2
#        was asked, with 0.53 for 0.5. The spring of that law is linear in a plane, as theory has it, but its dashpot seems to be
#        the one for a Hertzian spring: with sqrt(5/6) of the dashpot of a linear spring one expects 0.24 and 0.53. No warning.
# For us: compare with Kratos by DEM_D_Linear_viscous_Coulomb2D, which gives what is asked.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --no-compile KratosMultiphysics==10.4.4 KratosDEMApplication==10.4.4 numpy==2.4.6

cat >two.py <<'END'
import json
from importlib.metadata import version
from pathlib import Path

import KratosMultiphysics as kratos

kratos.Logger.GetDefaultOutput().SetSeverity(kratos.Logger.Severity.WARNING)
from KratosMultiphysics.DEMApplication.DEM_analysis_stage import DEMAnalysisStage

RADIUS, SPEED = 0.05, 0.5  # m, m/s
MESH = """Begin Properties 0
End Properties
Begin Nodes
1 -{x} 0 0
2 {x} 0 0
End Nodes
Begin Elements {element}
1 0 1
2 0 2
End Elements
Begin NodalData RADIUS
1 0 {radius}
2 0 {radius}
End NodalData
Begin SubModelPart Two
Begin SubModelPartNodes
1
2
End SubModelPartNodes
Begin SubModelPartElements
1
2
End SubModelPartElements
End SubModelPart
"""


class Collision(DEMAnalysisStage):
    def Initialize(self):
        super().Initialize()
        for node, sign in zip(self.spheres_model_part.Nodes, (1, -1)):
            node.SetSolutionStepValue(kratos.VELOCITY, kratos.Array3([sign * SPEED, 0, 0]))

    def Finalize(self):
        left, right = (node.GetSolutionStepValue(kratos.VELOCITY)[0] for node in self.spheres_model_part.Nodes)
        self.restitution = (right - left) / (2 * SPEED)
        self.parted = [node.X for node in self.spheres_model_part.Nodes][1] > RADIUS
        super().Finalize()


def collide(dimension, law, restitution):
    grains = {2: ("CylinderParticle2D", "CylinderPartDEMElement2D"), 3: ("SphericParticle3D", "SphericPartDEMElement3D")}
    element, kind = grains[dimension]
    Path("twoDEM.mdpa").write_text(MESH.format(x=RADIUS + 5e-7, element=element, radius=RADIUS))
    for other in "FEM_boundary", "Inlet", "Clusters":
        Path(f"twoDEM_{other}.mdpa").write_text("Begin Properties 0\nEnd Properties\n")
    grain = {"PARTICLE_DENSITY": 2000.0, "YOUNG_MODULUS": 1e8, "POISSON_RATIO": 0.25, "COMPUTE_WEAR": False}
    contact = {
        "COEFFICIENT_OF_RESTITUTION": restitution,
        "STATIC_FRICTION": 0.0,
        "DYNAMIC_FRICTION": 0.0,
        "FRICTION_DECAY": 500.0,
        "ROLLING_FRICTION": 0.0,
        "ROLLING_FRICTION_WITH_WALLS": 0.0,
        "DEM_DISCONTINUUM_CONSTITUTIVE_LAW_NAME": law,
    }
    materials = {
        "materials": [{"material_name": "sand", "material_id": 1, "Variables": grain}],
        "material_relations": [
            {"material_names_list": ["sand"] * 2, "material_ids_list": [1, 1], "Variables": contact}
        ],
        "material_assignation_table": [["SpheresPart.Two", "sand"]],
    }
    Path("MaterialsDEM.json").write_text(json.dumps(materials))
    project = {
        "problem_name": "two",
        "Dimension": dimension,
        "ElementType": kind,
        "GravityZ": 0.0,
        "dem_inlet_option": False,
        "do_print_results_option": False,
        "MaxTimeStep": 2e-5,
        "FinalTime": 8e-3,
        "NeighbourSearchFrequency": 1,
        "GraphExportFreq": 1.0,
        "VelTrapGraphExportFreq": 1.0,
        "OutputTimeStep": 1.0,
        "solver_settings": {"strategy": "sphere_strategy"},
        "processes": {},
    }
    collision = Collision(kratos.Model(), kratos.Parameters(json.dumps(project)))
    collision.Run()
    assert collision.parted
    return collision.restitution


print("seen: KratosDEMApplication", version("KratosDEMApplication"))
for dimension, law, asked in (
    (3, "DEM_D_Hertz_viscous_Coulomb", 0.2),
    (2, "DEM_D_Linear_viscous_Coulomb2D", 0.2),
    (2, "DEM_D_Hertz_viscous_Coulomb2D", 0.2),
    (2, "DEM_D_Hertz_viscous_Coulomb2D", 0.5),
):
    print(f"seen: {law}: {asked} asked, {collide(dimension, law, asked):.2f} seen", flush=True)
END

seen=$(OMP_NUM_THREADS=1 venv/bin/python two.py | sed -n 's/^seen: //p')
expected='KratosDEMApplication 10.4.4
DEM_D_Hertz_viscous_Coulomb: 0.2 asked, 0.20 seen
DEM_D_Linear_viscous_Coulomb2D: 0.2 asked, 0.20 seen
DEM_D_Hertz_viscous_Coulomb2D: 0.2 asked, 0.22 seen
DEM_D_Hertz_viscous_Coulomb2D: 0.5 asked, 0.53 seen'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
