# SPDX-License-Identifier: GPL-2.0-or-later
"""Curves and files as the decks write them, with known answers and without an engine."""

import json
import struct
from pathlib import Path

import numpy as np

from shearbox_tools.analysis.moments import Moment
from shearbox_tools.asking.models import INPUT, read_variables
from shearbox_tools.asking.request import Request

STEPS_PER_ROW = 5000
GRAINS = 350
DISCS = "id disc x y z radius angle type"
CONTACTS = "id1 id2 disc1 disc2 x y fn ft fx fy nx ny overlap sliding"
CELLS = "x y solid coordination stress_xx stress_yy stress_xy velocity_x velocity_y spin gradient_xx gradient_yy gradient_xy gradient_yx"


def write_record(folder: Path, request: Request) -> None:
    """run.json of a request with the parameters of the decks; makes the folder."""
    folder.mkdir(parents=True, exist_ok=True)
    record = {"identity": request.identity(read_variables(INPUT / "parameters.in")), "stresses": request.stresses}
    (folder / "run.json").write_text(json.dumps(record), encoding="utf-8")


def softening(s: np.ndarray, peak: float, at: float, residual: float) -> np.ndarray:
    """s (a + c s) / (a + b s)^2: peak 1 / (4 (b - c)) at a / (b - 2 c), residual c / b^2 < peak."""
    q = 1 / (4 * peak)
    b = (1 - np.sqrt(1 - 4 * residual * q)) / (2 * residual)
    c = b - q
    a = at * (b - 2 * c)
    return s * (a + c * s) / (a + b * s) ** 2


def correlated_noise(rng: np.random.Generator, rows: int, deviation: float, length: float) -> np.ndarray:
    """First-order autoregressive noise whose correlation falls to 1/e over `length` rows."""
    factor = np.exp(-1 / length)
    noise = rng.normal(size=rows) * deviation
    for i in range(1, rows):
        noise[i] = factor * noise[i - 1] + np.sqrt(1 - factor**2) * noise[i]
    return noise


def curves(sigma: float, travel: float, rows: int = 800, seed: int = 1) -> dict[str, np.ndarray]:
    """A whole shear phase: peak 0.5 sigma + 5 kPa at 2.5 mm of 8, lid rising steepest near 1.6 mm."""
    rng = np.random.default_rng(seed + int(sigma))
    s = (np.arange(rows) + 0.5) * travel / rows
    x = 8 * s / travel
    tau = softening(x, 0.5 * sigma + 5, 2.5, 0.3 * sigma) + correlated_noise(rng, rows, 0.02 * sigma, 8)
    lid = 0.5 / (1 + np.exp(-(x - 1.6) / 0.5)) - 0.5 / (1 + np.exp(1.6 / 0.5)) - 0.03 * x * np.exp(-x)
    return {
        "step": (np.arange(rows) + 1) * STEPS_PER_ROW,
        "displacement_mm": s,
        "tau_kPa": tau,
        "sigma_kPa": sigma * (1 + 0.001 * rng.normal(size=rows)),
        "lid_mm": lid + correlated_noise(rng, rows, 0.002, 8),
        "tau_upper_kPa": tau + rng.normal(size=rows),
        "trm": 0.6 + 0.2 * (1 - np.exp(-x)),
        "kinetic_J": np.full(rows, 1e-4),
        "dangerous": np.zeros(rows),
        "work_J": 1e-3 * sigma * s,
        "residual_J": -2e-7 * sigma * s,
    }


def inside(columns: dict[str, np.ndarray], sigma: float) -> dict[str, np.ndarray]:
    """Further columns of the same: the shear plane bears a tenth less than lid and lower half, all sides a hundredth; grains
    bear a third of the shear stress in the mean."""
    rows = len(columns["step"])
    return {
        "plane_kPa": np.full(rows, 0.9 * sigma),
        "plane_tau_kPa": 0.9 * columns["tau_kPa"],
        "sides_upper_kPa": np.full(rows, 0.01 * sigma),
        "flanges_upper_kPa": np.full(rows, 0.02 * sigma),
        "coordination": np.full(rows, 3.5),
        "inertial": np.full(rows, 1e-4),
        "stress_xx_kPa": np.full(rows, sigma),
        "stress_yy_kPa": np.full(rows, sigma),
        "stress_xy_kPa": columns["tau_kPa"] / 3,
    }


def write_shear(path: Path, columns: dict[str, np.ndarray], rows: slice = slice(None), mode: str = "w") -> None:
    """shear.dat as shear.in writes it."""
    table = np.column_stack(list(columns.values()))[rows]
    with path.open(mode, encoding="utf-8") as stream:
        if mode == "w":
            stream.write("# " + " ".join(columns) + "\n")
        for row in table:
            stream.write(" ".join(f"{value:.10g}" for value in row) + "\n")


def write_restart(path: Path, step: int) -> None:
    """A restart file as LAMMPS begins and ends it: mark, byte order, revision, version, units, step; mark."""
    mark = b"LammpS RestartT\0"
    texts = struct.pack("=ii5sii3s", 0, 5, b"2021\0", 4, 3, b"si\0")
    path.write_bytes(mark + struct.pack("=ii", 1, 2) + texts + struct.pack("=iq", 5, step) + b"grains" + mark)


def write_row(path: Path, **values: float) -> None:
    """A csv file of a header and a row."""
    path.write_text(",".join(values) + "\n" + ",".join(f"{v:.10g}" for v in values.values()) + "\n", encoding="utf-8")


def bed() -> dict[str, float]:
    """Numbers of a packed or a consolidated specimen, as the decks write them."""
    return {
        "grains": 350,
        "height_m": 0.0987,
        "solid_fraction": 0.835,
        "solid_fraction_bottom": 0.834,
        "solid_fraction_top": 0.836,
        "unbalanced": 8e-5,
        "kinetic_J": 3e-12,
        "steps": 123000,
    }


def packing(width: float, height: float, radius: float) -> np.ndarray:
    """(n, 2) centres of a hexagonal packing of equal discs in the box, in m."""
    across = int((width - 2 * radius) / (2 * radius)) + 1
    up = int((height - 2 * radius) / (np.sqrt(3) * radius)) + 1
    centres = [
        (radius + 2 * radius * i + radius * (j % 2), radius + np.sqrt(3) * radius * j)
        for j in range(up)
        for i in range(across - j % 2)
    ]
    return np.array(centres)


def walls(width: float, half_height: float, diameter: float, shift: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """(n, 2) centres of floor, lid, sides and flanges; which of them are of the lower half, moved by `shift`; which of
    the lid."""
    columns = np.arange(half_height - diameter / 2, -diameter, -diameter)
    floor = np.arange(diameter / 2, width, diameter)
    out = np.arange(1, 6) * diameter
    lower = [(x, -diameter / 2) for x in floor]
    for y in columns:
        lower += [(-diameter / 2, y), (width + diameter / 2, y)]
    lower += [(-diameter / 2 - d, half_height - diameter / 2) for d in out]
    lower += [(width + diameter / 2 + d, half_height - diameter / 2) for d in out]
    upper = [(x, 2 * half_height - y) for x, y in lower]
    centres = np.array([(x + shift, y) for x, y in lower] + upper)
    return centres, np.arange(len(centres)) < len(lower), centres[:, 1] > 2 * half_height


def write_frames(folder: Path, steps: list[int], travel: float, width: float = 0.1, half_height: float = 0.05) -> None:
    """The dumps of a hexagonal packing that shears homogeneously, under 100 kPa in y."""
    radius = 0.00277
    start = packing(width, 2 * half_height, radius)[:GRAINS]
    texts: dict[str, list[str]] = {"grains": [], "discs": [], "contacts": [], "cells": []}
    for number, step in enumerate(steps):
        shear = travel * 1e-3 * number / max(1, len(steps) - 1)
        centres = start + np.column_stack(
            [shear * (0.5 - start[:, 1] / (2 * half_height)) + shear / 2, 0 * start[:, 1]]
        )
        angle = 0.01 * np.arange(len(start)) + 2 * shear / radius * np.sin(40 * start[:, 0]) * np.exp(
            -(((start[:, 1] - half_height) / 0.02) ** 2)
        )
        border, is_lower, is_lid = walls(width, half_height, 2 * radius, shear)
        flags = ["0 0 0"] * len(centres) + [f"1 {lower:d} {lid:d}" for lower, lid in zip(is_lower, is_lid)]
        where = np.vstack([centres, border])
        angles = np.concatenate([angle, np.zeros(len(border))])
        types = [1] * len(centres) + [2] * len(border)
        rows = list(zip(types, where, angles))
        texts["grains"].append(
            _frame(
                step,
                "ATOMS id type x y z vx vy omegaz radius v_angle c_trm v_wall v_lower v_lid",
                [
                    f"{i + 1} {t} {x:.8g} {y:.8g} 0 0 0 0 {radius} {a:.6g} 0.7 {flags[i]}"
                    for i, (t, (x, y), a) in enumerate(rows)
                ],
            )
        )
        texts["discs"].append(
            _frame(
                step,
                f"ATOMS {DISCS}",
                [f"{i + 1} 0 {x:.8g} {y:.8g} 0 {radius} {a:.6g} {t}" for i, (t, (x, y), a) in enumerate(rows)],
            )
        )
        texts["contacts"].append(
            _frame(
                step,
                f"ENTRIES {CONTACTS}",
                _contact_rows(centres, radius),
            )
        )
        texts["cells"].append(
            _frame(
                step,
                f"ENTRIES {CELLS}",
                _cell_rows(width, half_height, travel),
            )
        )
    for name, frames in texts.items():
        (folder / f"{name}.dump").write_text("".join(frames), encoding="utf-8")
    assert len(start) == GRAINS


def with_names_beside(folder: Path) -> None:
    """Turn dumps into those of an earlier version: numbers of columns in their heads, names in files beside them."""
    for name, columns in (("discs", DISCS), ("contacts", CONTACTS), ("cells", CELLS)):
        dump = folder / f"{name}.dump"
        numbers = " ".join(f"c_{name}[{k}]" for k in range(1, len(columns.split()) + 1))
        text = dump.read_text(encoding="utf-8")
        for kind in ("ENTRIES", "ATOMS"):
            text = text.replace(f"ITEM: {kind} {columns}", f"ITEM: ENTRIES {numbers}")
        dump.write_text(text, encoding="utf-8")
        dump.with_suffix(".columns").write_text(columns + "\n", encoding="utf-8")


def _cell_rows(width: float, half_height: float, travel: float, count: int = 10) -> list[str]:
    """Cells of a specimen that shears by the same rate everywhere, in one second."""
    rate = travel * 1e-3 / (2 * half_height)
    centres = (np.arange(count) + 0.5) / count
    return [
        f"{x * width:.8g} {y * 2 * half_height:.8g} 0.82 4 500 1000 300 {rate * y * 2 * half_height:.6g} 0 "
        f"{-rate / 2:.6g} 0 0 {rate:.6g} 0"
        for y in centres
        for x in centres
    ]


def _contact_rows(centres: np.ndarray, radius: float) -> list[str]:
    apart = centres[:, None] - centres[None]
    distance = np.hypot(apart[..., 0], apart[..., 1])
    rows: list[str] = []
    for i, j in np.argwhere(np.tril(distance < 2.02 * radius, -1)):
        n = apart[i, j] / distance[i, j]
        force = 100 * (1 + n[0] * n[1]) * (1 + 0.5 * np.sin(300 * centres[i, 0]))
        x, y = (centres[i] + centres[j]) / 2
        rows.append(
            f"{i + 1} {j + 1} 0 0 {x:.8g} {y:.8g} {force:.6g} 0 {force * n[0]:.6g} "
            f"{force * n[1]:.6g} {n[0]:.6g} {n[1]:.6g} 1e-6 0"
        )
    return rows


def _frame(step: int, columns: str, rows: list[str]) -> str:
    kind = columns.split()[0]
    return (
        f"ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF {kind}\n{len(rows)}\nITEM: BOX BOUNDS ff ff pp\n"
        f"-1 1\n-1 1\n-0.5 0.5\nITEM: {columns}\n" + "".join(row + "\n" for row in rows)
    )


def moment(ids: list[int], x: list[float]) -> Moment:
    """Discs of radius 1 in a row; of grain 1, which is free, and of walls."""
    discs = {"id": np.array(ids), "x": np.array(x), "y": np.zeros(len(x)), "radius": np.ones(len(x))}
    grains = {"id": np.unique(ids), "wall": (np.unique(ids) != 1).astype(float)}
    return Moment(0, grains, discs, {}, None)
